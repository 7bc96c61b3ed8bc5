#include "frontal/slurm/steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace graycube::slurm {

Steps::Steps(const std::vector<std::string>& hosts, bool waits, double now_s) {
  for (const std::string& host : hosts) {
    Step step;
    step.host = host;
    step.next_s = waits ? now_s + kComeBack_s : now_s;
    steps_.push_back(std::move(step));
  }
}

std::vector<std::string> Steps::take_starts(const std::set<std::string>& here, double now_s) {
  std::vector<std::string> starts;
  for (Step& step : steps_) {
    if (step.is_running || now_s < step.next_s || here.contains(step.host)) continue;
    step.is_running = true;
    step.is_ending = step.has_joined = false;
    step.started_s = now_s;
    starts.push_back(step.host);
  }
  return starts;
}

std::vector<std::string> Steps::take_ends(const std::set<std::string>& here, double now_s) {
  std::vector<std::string> ends;
  for (Step& step : steps_) {
    if (!step.is_running || step.is_ending) continue;
    if (here.contains(step.host)) {
      step.has_joined = true;
      step.failures = 0;
      // Patience begins anew when the host is lost: its process may come back by itself.
      step.started_s = now_s;
    } else if (now_s - step.started_s > kJoinPatience_s) {
      step.is_ending = true;
      ends.push_back(step.host);
    }
  }
  return ends;
}

std::string Steps::ended(const std::string& host, const std::string& how, double now_s) {
  const auto step = std::ranges::find(steps_, host, &Step::host);
  if (step == steps_.end()) return {};
  const double pause_s =
      std::min(kLongestPause_s, kFirstPause_s * std::exp2(std::min(step->failures, 10u)));
  ++step->failures;
  step->is_running = false;
  step->next_s = now_s + pause_s;
  std::array<char, 64> again{};
  std::snprintf(again.data(), again.size(), "; it is started again in %.0f s", pause_s);
  return "host " + host + ": its step of Slurm " + how + again.data();
}

}  // namespace graycube::slurm

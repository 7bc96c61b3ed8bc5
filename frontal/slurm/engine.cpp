#include "frontal/slurm/engine.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

namespace graycube::slurm {
namespace {

std::vector<std::string> names_of(const Hosts& hosts) {
  std::vector<std::string> names;
  for (const auto& [name, cpus] : hosts) names.push_back(name);
  return names;
}

}  // namespace

std::optional<Hosts> hosts_of(std::string_view text) {
  Hosts hosts;
  while (!text.empty()) {
    const std::string_view item = text.substr(0, text.find(','));
    text.remove_prefix(std::min(item.size() + 1, text.size()));
    const std::size_t colon = item.rfind(':');
    if (colon == item.npos || colon == 0) return std::nullopt;
    std::uint32_t cpus = 0;
    const char* const last = item.data() + item.size();
    const auto [end, error] = std::from_chars(item.data() + colon + 1, last, cpus);
    if (error != std::errc() || end != last || cpus == 0) return std::nullopt;
    hosts.emplace_back(item.substr(0, colon), cpus);
  }
  if (hosts.empty()) return std::nullopt;
  return hosts;
}

Engine::Engine(const Hosts& hosts, StepSetting setting, bool waits, double now_s)
    : cpus_(hosts.begin(), hosts.end()),
      steps_(names_of(hosts), waits, now_s),
      processes_(std::move(setting)) {}

std::vector<std::string> Engine::work(const std::set<std::string>& here, double now_s) {
  std::vector<std::string> told;
  for (const StepEnd& end : processes_.reap())
    told.push_back(steps_.ended(end.host, end.how, now_s));
  for (const std::string& host : steps_.take_ends(here, now_s)) {
    told.push_back("host " + host + " hasn't joined for long; its step of Slurm is ended");
    processes_.end(host);
  }
  for (const std::string& host : steps_.take_starts(here, now_s))
    processes_.start(host, cpus_.at(host));
  return told;
}

}  // namespace graycube::slurm

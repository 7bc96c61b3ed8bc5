#include "frontal/rendering/deadlock_watch.hpp"

#include <algorithm>
#include <utility>

namespace graycube {

std::vector<Rank> DeadlockWatch::add(Rank rank, const control::WaitReport& report,
                                     std::uint64_t last_ping) {
  if (report.ping <= next_after_ || report.ping < ping_) return {};
  if (report.ping > ping_) {
    ping_ = report.ping;
    reports_.assign(cube_.nodes(), std::nullopt);
    count_ = 0;
  }
  auto& mine = reports_[rank.value];
  if (mine || report.granted.size() != cube_.dimension() ||
      report.received.size() != cube_.dimension() || report.waits_for >= cube_.dimension()) {
    return {};
  }
  mine = report;
  if (++count_ < cube_.nodes()) return {};
  std::vector<Rank> cycle;
  if (!earlier_.empty()) cycle = find_cycle();
  earlier_ = std::exchange(reports_, Round(cube_.nodes()));
  count_ = 0;
  next_after_ = last_ping;
  return cycle;
}

std::uint32_t DeadlockWatch::stalled() const {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(earlier_, [](const auto& r) { return r && r->is_stalled; }));
}

std::optional<Rank> DeadlockWatch::waits_for(Rank rank) const {
  const control::WaitReport& then = *earlier_[rank.value];
  const control::WaitReport& now = *reports_[rank.value];
  const bool same = then.is_stalled && now.is_stalled && then.waits_for == now.waits_for &&
                    then.moves == now.moves && then.granted == now.granted &&
                    then.received == now.received;
  if (!same) return std::nullopt;
  const Rank next = cube_.neighbour(rank, now.waits_for);
  // The bit across which two nodes are linked is the same for both.
  if (reports_[next.value]->granted[now.waits_for] != now.received[now.waits_for]) {
    return std::nullopt;
  }
  return next;
}

std::vector<Rank> DeadlockWatch::find_cycle() const {
  std::vector<std::uint32_t> visit(cube_.nodes(), 0);
  for (std::uint32_t start = 0; start < cube_.nodes(); ++start) {
    std::optional<Rank> at = Rank{start};
    while (at && visit[at->value] == 0) {
      visit[at->value] = start + 1;
      at = waits_for(*at);
    }
    if (!at || visit[at->value] != start + 1) continue;
    std::vector<Rank> cycle;
    const Rank first = *at;
    do {
      cycle.push_back(*at);
      at = waits_for(*at);
    } while (*at != first);
    return cycle;
  }
  return {};
}

}  // namespace graycube

#include "figures/traffic.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace graycube::figures {

std::vector<LinkTraffic> traffic_of(const RunRecord& run, std::size_t parts) {
  std::map<std::pair<Rank, Rank>, LinkTraffic> links;
  for (const RayShipment& s : run.shipments) {
    LinkTraffic& link =
        links.try_emplace({s.from, s.to}, LinkTraffic{s.from, s.to, 0, {}}).first->second;
    link.over_time.resize(parts);
    const double share = run.end_s > 0 ? s.sent_s / run.end_s : 0;
    const auto part =
        static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(parts));
    link.rays += s.rays;
    link.over_time[std::min(part, parts - 1)] += s.rays;
  }
  std::vector<LinkTraffic> list;
  for (auto& [ends, link] : links) list.push_back(std::move(link));
  std::stable_sort(list.begin(), list.end(),
                   [](const LinkTraffic& a, const LinkTraffic& b) { return a.rays > b.rays; });
  return list;
}

std::vector<std::uint64_t> received_by(const std::vector<LinkTraffic>& links, std::uint32_t nodes) {
  std::vector<std::uint64_t> received(nodes);
  for (const LinkTraffic& link : links) received[link.to.value] += link.rays;
  return received;
}

}  // namespace graycube::figures

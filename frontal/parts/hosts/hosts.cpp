#include "frontal/parts/hosts/hosts.hpp"

#include <algorithm>
#include <utility>

namespace graycube {

std::uint32_t Hosts::Host::room(std::uint32_t share) const {
  const auto has = static_cast<std::uint32_t>(nodes.size());
  const std::uint32_t most = std::min(about.slots, share);
  return most > has ? most - has : 0;
}

std::uint32_t Hosts::Host::room_in_need() const {
  const std::uint64_t most = std::uint64_t{about.cores} * kMostNodesOnCore;
  const std::uint64_t limit = std::clamp<std::uint64_t>(most, about.slots, kMaxNodes);
  return limit > nodes.size() ? static_cast<std::uint32_t>(limit - nodes.size()) : 0;
}

std::optional<Refusal> Hosts::join(const PeerId& peer, const control::Join& about, double now_s) {
  if (!about.folder.starts_with('/'))
    return Refusal{0, FailureCode::kBadRequest, "folder", "expected an absolute path"};
  if (hosts_.size() >= kMaxNodes) {
    return Refusal{0, FailureCode::kBusy, "",
                   "this farm has " + std::to_string(kMaxNodes) + " hosts already"};
  }
  if (numbers_.contains(peer))
    return Refusal{0, FailureCode::kBadRequest, "type", "this host has joined already"};
  Host& host = hosts_[next_number_];
  host.peer = peer;
  host.about = about;
  host.last_heard_s = now_s;
  numbers_[peer] = next_number_++;
  changed_s_ = now_s;
  return std::nullopt;
}

void Hosts::heard(const PeerId& peer, double now_s) {
  const auto number = numbers_.find(peer);
  if (number != numbers_.end()) hosts_[number->second].last_heard_s = now_s;
}

void Hosts::alive(const PeerId& peer, const control::Alive& m) {
  const auto number = numbers_.find(peer);
  if (number != numbers_.end()) hosts_[number->second].stopped = m.stopped;
}

Hosts::Lost Hosts::remove(Number number, double now_s) {
  const Host& host = hosts_.at(number);
  Lost lost{host.about.host + " (process " + std::to_string(host.about.pid) + ")",
            now_s - host.last_heard_s,
            {}};
  for (const auto& [rank, place] : places_) {
    if (place == number) lost.nodes.push_back(rank);
  }
  std::erase_if(places_, [number](const auto& place) { return place.second == number; });
  numbers_.erase(host.peer);
  hosts_.erase(number);
  changed_s_ = now_s;
  return lost;
}

std::optional<Hosts::Lost> Hosts::leave(const PeerId& peer, double now_s) {
  const auto number = numbers_.find(peer);
  if (number == numbers_.end()) return std::nullopt;
  return remove(number->second, now_s);
}

std::vector<Hosts::Lost> Hosts::take_silent(double now_s) {
  std::vector<Number> silent;
  for (const auto& [number, host] : hosts_) {
    if (now_s - host.last_heard_s >= silence_s_) silent.push_back(number);
  }
  std::vector<Lost> lost;
  for (const Number number : silent) lost.push_back(remove(number, now_s));
  return lost;
}

void Hosts::was_held_up(double seconds) {
  for (auto& [number, host] : hosts_) host.last_heard_s += seconds;
}

void Hosts::want(const Process& process) {
  std::erase_if(waiting_, [&](const Process& w) { return w.rank == process.rank; });
  const auto behind = std::ranges::upper_bound(waiting_, process.rank, {}, &Process::rank);
  waiting_.insert(behind, process);
  const auto place = places_.find(process.rank);
  if (place == places_.end()) return;
  hosts_[place->second].nodes.erase(process.rank);
  places_.erase(place);
}

std::uint32_t Hosts::share_of(std::uint32_t nodes, double now_s) const {
  std::uint32_t share = 1;
  for (; share < nodes; share *= 2) {
    std::uint64_t room = 0;
    for (const auto& [number, host] : hosts_) {
      if (host.takes_nodes(now_s)) room += std::min(host.about.slots, share);
    }
    if (room >= nodes) break;
  }
  return share;
}

/// Where the rank before it is, if there is a slot: links between consecutive ranks stay inside
/// their host. Else the host with the most free slots.
std::optional<Hosts::Number> Hosts::host_for(const Process& process, std::uint32_t share,
                                             double now_s) const {
  const std::uint32_t rank = process.rank.value;
  const auto before = rank > 0 ? host_of(Rank{rank - 1}) : std::nullopt;
  std::optional<Number> best;
  std::pair<bool, std::uint32_t> most;
  for (const auto& [number, host] : hosts_) {
    const std::pair merit{before == number, host.room(share)};
    if (!host.takes_nodes(now_s) || merit.second == 0) continue;
    // Of equals the first: hosts fill up in the order in which they came.
    if (best && merit <= most) continue;
    best = number;
    most = merit;
  }
  return best;
}

std::optional<Hosts::Number> Hosts::host_in_need(double now_s) const {
  std::optional<std::pair<double, Number>> least;
  for (const auto& [number, host] : hosts_) {
    if (!host.takes_nodes(now_s) || host.room_in_need() == 0) continue;
    const double load = static_cast<double>(host.nodes.size() + 1) / host.about.cores;
    if (!least || load < least->first) least = {load, number};
  }
  if (!least) return std::nullopt;
  return least->second;
}

void Hosts::give(Number number, const Process& process) {
  hosts_[number].nodes[process.rank] = process.incarnation;
  places_[process.rank] = number;
  starts_[number].nodes.push_back({process.rank.value, process.incarnation});
}

std::vector<Hosts::Placed> Hosts::place(std::uint32_t nodes, bool in_need, double now_s) {
  std::vector<Placed> placed;
  if (waiting_.empty()) return placed;
  const std::uint32_t share = share_of(nodes, now_s);
  std::erase_if(waiting_, [&](const Process& process) {
    auto number = host_for(process, share, now_s);
    if (!number && in_need) number = host_in_need(now_s);
    if (!number) return false;
    give(*number, process);
    placed.push_back({process.rank, *number});
    return true;
  });
  for (auto& [number, started] : std::exchange(starts_, {}))
    orders_.emplace_back(hosts_[number].peer, std::move(started));
  return placed;
}

void Hosts::kill(const Process& process) {
  const auto number = host_of(process.rank);
  if (!number) return;
  orders_.emplace_back(hosts_[*number].peer,
                       control::EndNode{process.rank.value, process.incarnation});
}

void Hosts::has_host(Rank guest, Rank host) {
  std::erase_if(waiting_, [&](const Process& w) { return w.rank == guest; });
  if (const auto number = host_of(host)) places_[guest] = *number;
}

bool Hosts::ended(const PeerId& peer, const Process& process, bool was_here, double now_s) {
  const auto number = numbers_.find(peer);
  if (number == numbers_.end()) return false;
  Host& host = hosts_[number->second];
  const auto node = host.nodes.find(process.rank);
  if (node == host.nodes.end() || node->second != process.incarnation) return false;
  host.nodes.erase(node);
  host.failed_starts = was_here ? 0 : host.failed_starts + 1;
  if (host.failed_starts >= kMaxFailedOnHost) {
    host.failed_starts = 0;
    host.barred_until_s = now_s + kBarred_s;
    changed_s_ = now_s;
  }
  return true;
}

void Hosts::clear() {
  for (auto& [number, host] : hosts_) {
    for (const auto& [rank, incarnation] : host.nodes)
      orders_.emplace_back(host.peer, control::EndNode{rank.value, incarnation});
    host.nodes.clear();
  }
  places_.clear();
  waiting_.clear();
}

std::uint32_t Hosts::slots(double now_s) const {
  std::uint64_t slots = 0;
  for (const auto& [number, host] : hosts_) {
    if (host.takes_nodes(now_s)) slots += host.about.slots;
  }
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(slots, kMaxNodes));
}

bool Hosts::has_room(double now_s) const { return host_in_need(now_s).has_value(); }

bool Hosts::is_uneven(std::uint32_t nodes, double now_s) const {
  const std::uint32_t share = share_of(nodes, now_s);
  return std::ranges::any_of(hosts_, [&](const auto& h) {
    return h.second.nodes.size() > std::min(h.second.about.slots, share);
  });
}

std::optional<Hosts::Number> Hosts::host_of(Rank node) const {
  const auto place = places_.find(node);
  if (place == places_.end()) return std::nullopt;
  return place->second;
}

std::map<Hosts::Number, std::vector<Rank>> Hosts::nodes_by_host() const {
  std::map<Number, std::vector<Rank>> nodes;
  for (const auto& [rank, host] : places_) nodes[host].push_back(rank);
  return nodes;
}

std::vector<PeerId> Hosts::peers() const {
  std::vector<PeerId> peers;
  for (const auto& [peer, number] : numbers_) peers.push_back(peer);
  return peers;
}

std::set<std::string> Hosts::names() const {
  std::set<std::string> names;
  for (const auto& [number, host] : hosts_) names.insert(host.about.host);
  return names;
}

bool Hosts::are_local(Number a, Number b) const {
  return a == b || hosts_.at(a).about.tag == hosts_.at(b).about.tag;
}

bool Hosts::can_run(Rank node, double now_s) const {
  const auto number = host_of(node);
  if (!number) return false;
  const Host& host = hosts_.at(*number);
  return now_s - host.last_heard_s < silence_s_ &&
         std::ranges::count(host.stopped, node.value) == 0;
}

std::vector<control::HostInfo> Hosts::list(double now_s) const {
  std::vector<control::HostInfo> list;
  for (const auto& [number, host] : hosts_) {
    const char* state = host.nodes.empty() ? "waits for nodes" : "runs nodes";
    if (!host.takes_nodes(now_s)) state = "its nodes don't start: it gets none for a while";
    list.push_back({host.about.host, host.about.cores, host.about.memory_bytes, host.about.slots,
                    static_cast<std::uint32_t>(host.nodes.size()), host.about.pid, state});
  }
  return list;
}

}  // namespace graycube

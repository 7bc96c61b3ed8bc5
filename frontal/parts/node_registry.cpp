#include "frontal/parts/node_registry.hpp"

#include <algorithm>
#include <tuple>

namespace graycube {

NodeRegistry::NodeRegistry(const Hypercube& cube, const Patience& patience)
    : cube_(cube), patience_(patience), nodes_(cube.nodes()) {
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) start(Rank{rank}, 0);
}

void NodeRegistry::begin_anew(const Hypercube& cube, double now_s) {
  cube_ = cube;
  nodes_.assign(cube.nodes(), {});
  peers_.clear();
  starts_.clear();
  kills_.clear();
  was_whole_ = false;
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) start(Rank{rank}, now_s);
}

void NodeRegistry::start(Rank rank, double now_s) {
  Record& node = nodes_[rank.value];
  node = {};
  node.incarnation = next_incarnation_++;
  node.last_heard_s = now_s;
  starts_.push_back({rank, node.incarnation});
}

std::optional<NodeRegistry::Hosting> NodeRegistry::host(Rank rank, double now_s) {
  const auto host = host_for(rank);
  if (!host) return std::nullopt;
  Record& node = nodes_[rank.value];
  node = {};
  node.incarnation = next_incarnation_++;
  node.pid = nodes_[host->value].pid;
  node.host = nodes_[host->value].host;
  node.is_guest = true;
  node.last_heard_s = now_s;
  hostings_.push_back({{rank, node.incarnation}, {*host, nodes_[host->value].incarnation}});
  return hostings_.back();
}

/// The process that has the fewest nodes so far; of several a neighbour's, as then one link less
/// leaves the process.
std::optional<Rank> NodeRegistry::host_for(Rank rank) const {
  if (!was_whole_ || failed_guests_ >= kMaxFailedStarts) return std::nullopt;
  using Merit = std::tuple<std::size_t, bool, Rank>;
  std::optional<Merit> best;
  for (std::uint32_t r = 0; r < nodes_.size(); ++r) {
    if (!nodes_[r].is_here || Rank{r} == rank) continue;
    const Merit merit{in_process_of(Rank{r}).size(), !cube_.link_between(rank, Rank{r}), Rank{r}};
    if (!best || merit < *best) best = merit;
  }
  if (!best) return std::nullopt;
  return std::get<Rank>(*best);
}

std::vector<Rank> NodeRegistry::in_process_of(Rank rank) const {
  std::vector<Rank> ranks{rank};
  for (std::uint32_t r = 0; r < nodes_.size(); ++r) {
    if (Rank{r} != rank && share_process(nodes_[r], nodes_[rank.value])) ranks.push_back(Rank{r});
  }
  return ranks;
}

std::optional<Refusal> NodeRegistry::hello(const PeerId& peer, const control::Hello& hello,
                                           double now_s) {
  if (hello.rank >= nodes_.size()) {
    return Refusal{0, FailureCode::kBadRequest, "rank", "no such node in this farm"};
  }
  Record& node = nodes_[hello.rank];
  if (node.incarnation != hello.incarnation) {
    return Refusal{0, FailureCode::kBadRequest, "incarnation", "another process is this node"};
  }
  node.is_here = true;
  node.pid = hello.pid;
  node.endpoint = hello.endpoint;
  node.remote_endpoint = hello.remote_endpoint;
  node.threads = hello.threads;
  node.last_heard_s = now_s;
  peers_[peer] = Rank{hello.rank};
  failed_starts_ = 0;
  if (node.is_guest) failed_guests_ = 0;
  was_whole_ = was_whole_ || all_here();
  return std::nullopt;
}

std::optional<Rank> NodeRegistry::rank_of(const PeerId& peer) const {
  const auto found = peers_.find(peer);
  if (found == peers_.end()) return std::nullopt;
  return found->second;
}

void NodeRegistry::was_held_up(double seconds) {
  for (Record& node : nodes_) node.last_heard_s += seconds;
}

std::vector<Rank> NodeRegistry::take_silent(
    double now_s, const std::function<bool(Rank, std::uint64_t)>& is_only_slow) {
  std::vector<Rank> silent;
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) {
    Record& node = nodes_[rank];
    // A node that was to be started before time was first told counts as silent only from then on.
    if (node.last_heard_s == 0) node.last_heard_s = now_s;
    const double silent_s = now_s - node.last_heard_s;
    const double patience_s = node.is_here ? patience_.silence_s : patience_.start_s;
    if (silent_s < patience_s) continue;
    if (node.is_here && silent_s < kPatienceWithSlow * patience_s &&
        is_only_slow(Rank{rank}, node.pid))
      continue;
    const auto ends_already = [&](Rank r) { return share_process(nodes_[r.value], node); };
    if (std::ranges::any_of(silent, ends_already)) continue;
    silent.push_back(Rank{rank});
    kill(Rank{rank});
  }
  return silent;
}

NodeRegistry::Lost NodeRegistry::lose(Rank rank, double now_s) {
  const Record& node = nodes_[rank.value];
  std::erase_if(peers_, [rank](const auto& peer) { return peer.second == rank; });
  std::string name = "node " + std::to_string(rank.value);
  if (node.pid != 0) name += " (process " + std::to_string(node.pid) + ")";
  if (!node.is_here) ++(node.is_guest ? failed_guests_ : failed_starts_);
  return {std::move(name), now_s - node.last_heard_s,
          !node.is_here && !node.is_guest && failed_starts_ >= kMaxFailedStarts};
}

bool NodeRegistry::all_here() const { return std::ranges::all_of(nodes_, &Record::is_here); }

std::uint32_t NodeRegistry::count_here() const {
  return static_cast<std::uint32_t>(std::ranges::count_if(nodes_, &Record::is_here));
}

bool NodeRegistry::all_left() const { return std::ranges::all_of(nodes_, &Record::has_left); }

std::vector<std::string> NodeRegistry::endpoints() const {
  std::vector<std::string> endpoints;
  for (const Record& node : nodes_) endpoints.push_back(node.endpoint);
  return endpoints;
}

std::vector<std::string> NodeRegistry::remote_endpoints() const {
  std::vector<std::string> endpoints;
  for (const Record& node : nodes_) endpoints.push_back(node.remote_endpoint);
  return endpoints;
}

std::vector<std::uint32_t> NodeRegistry::incarnations() const {
  std::vector<std::uint32_t> incarnations;
  for (const Record& node : nodes_) incarnations.push_back(node.incarnation);
  return incarnations;
}

control::NodeList NodeRegistry::list(bool are_busy) const {
  control::NodeList list;
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) {
    const Record& node = nodes_[rank];
    const NodeState here = are_busy ? NodeState::kBusy : NodeState::kIdle;
    list.nodes.push_back({rank,
                          cube_.label_of(Rank{rank}).value,
                          node.pid,
                          node.is_here ? here : NodeState::kStarting,
                          node.endpoint,
                          node.threads,
                          {}});
  }
  return list;
}

}  // namespace graycube

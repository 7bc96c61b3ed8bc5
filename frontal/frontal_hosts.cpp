// The frontal of a farm whose nodes run on hosts that join it: where nodes are, and how many.
#include <bit>
#include <utility>

#include "frontal/frontal.hpp"
#include "overloaded.hpp"
#include "proto/control.hpp"

namespace graycube {
namespace {

/// Hosts that come within so many seconds of each other are waited for, before nodes are dealt.
constexpr double kHostPatience_s = 3;

}  // namespace

void Frontal::on_host_message(const PeerId& peer, const MessageView& message) {
  const auto decoded = decode(message.text());
  if (const auto* error = std::get_if<ControlError>(&decoded)) {
    return post_.answer(peer, Refusal{0, FailureCode::kBadRequest, error->field, error->why});
  }
  if (!hosts_) {
    return post_.answer(peer, Refusal{0, FailureCode::kBadRequest, "",
                                      "this farm runs its nodes itself; 'graycube up --farm "
                                      "joined' starts one that hosts can join"});
  }
  hosts_->heard(peer, now_s_);
  on_host(peer, std::get<ControlMessage>(decoded));
  get_on();
}

void Frontal::on_host(const PeerId& peer, const ControlMessage& message) {
  if (const auto* join = std::get_if<control::Join>(&message)) return on_join(peer, *join);
  if (!hosts_->is_here(peer)) {
    return post_.answer(peer, Refusal{0, FailureCode::kBadRequest, "",
                                      "this host has not joined, or is taken for lost"});
  }
  if (const auto* ended = std::get_if<control::NodeEnded>(&message))
    return on_node_ended(peer, *ended);
  if (const auto* alive = std::get_if<control::Alive>(&message)) return hosts_->alive(peer, *alive);
  if (std::holds_alternative<control::Leave>(message)) {
    if (const auto lost = hosts_->leave(peer, now_s_)) lose_host(*lost, "leaves");
    return;
  }
  post_.answer(peer, Refusal{0, FailureCode::kBadRequest, "type",
                             "'" + std::string(type_of(message)) + "' is not for a host to send"});
}

void Frontal::on_join(const PeerId& peer, const control::Join& m) {
  if (is_going_down_)
    return post_.answer(peer, Refusal{0, FailureCode::kBusy, "", "the farm is going down"});
  if (m.version != options_.version) {
    return post_.answer(peer, Refusal{0, FailureCode::kBadRequest, "version",
                                      "this farm is of Graycube " + options_.version +
                                          ", the host of " + m.version});
  }
  if (auto refusal = hosts_->join(peer, m, now_s_)) return post_.answer(peer, *std::move(refusal));
  log_.host_joins(m);
  post_.to_peer(peer,
                control::Joined{options_.nodes_port, options_.threads, heartbeat_.interval_ms(),
                                static_cast<std::uint32_t>(options_.silence_s * 1000)});
}

void Frontal::on_node_ended(const PeerId& peer, const control::NodeEnded& m) {
  const Process process{Rank{m.rank}, m.incarnation};
  const bool was_here =
      options_.cube.has(process.rank) && nodes_.is_current(process) && nodes_.is_here(process.rank);
  if (!hosts_->ended(peer, process, was_here, now_s_) || !options_.cube.has(process.rank)) return;
  m.was_started ? on_node_exit(process, m.how) : on_start_failure(process, m.how);
}

void Frontal::lose_host(const Hosts::Lost& host, const std::string& how) {
  log_.host_is_lost(host.name, how, host.nodes.size());
  std::vector<Rank> ranks;
  for (const Rank rank : host.nodes) {
    if (!options_.cube.has(rank)) continue;
    nodes_.has_left(rank);
    ranks.push_back(rank);
  }
  if (!ranks.empty() && !is_going_down_) lose(ranks, "its host " + host.name + " " + how);
}

void Frontal::look_after_hosts() {
  for (const Hosts::Lost& host : hosts_->take_silent(now_s_)) lose_host(host, "fell silent");
  // What has no host yet isn't silent.
  for (const Process& waiting : hosts_->waiting()) nodes_.heard(waiting.rank, now_s_);
}

/// While a job is on its farm keeps its size: hosts that are left get the nodes of those that are
/// not. Between jobs the farm is as large as the hosts allow.
void Frontal::serve_hosts() {
  if (is_going_down_) return;
  if (!jobs_.job_that_is_on()) fit_to_hosts();
  for (const Process& process : nodes_.take_kills()) hosts_->kill(process);
  for (const Process& process : nodes_.take_starts()) hosts_->want(process);
  const bool in_need = jobs_.job_that_is_on().has_value();
  const bool is_settled = now_s_ - hosts_->changed_s() >= kHostPatience_s ||
                          hosts_->slots(now_s_) >= options_.cube.nodes();
  if (in_need || is_settled) {
    const auto placed = hosts_->place(options_.cube.nodes(), in_need, now_s_);
    for (const auto& [rank, host] : placed) {
      nodes_.set_host(rank, host);
      nodes_.heard(rank, now_s_);
    }
    if (!placed.empty())
      options_.hosts = static_cast<std::uint32_t>(hosts_->nodes_by_host().size());
  }
  for (auto& [peer, order] : hosts_->take_orders()) post_.to_peer(peer, order);
}

void Frontal::fit_to_hosts() {
  const std::uint32_t slots = hosts_->slots(now_s_);
  if (slots == 0 || now_s_ - hosts_->changed_s() < kHostPatience_s) return;
  const std::uint32_t nodes = std::min(*options_.most_nodes_on_hosts, std::bit_floor(slots));
  if (nodes == options_.cube.nodes() && !hosts_->is_uneven(nodes, now_s_)) return;
  hosts_->clear();
  options_.cube = *Hypercube::of_size(nodes);
  post_.begin_anew(nodes);
  nodes_.begin_anew(options_.cube, now_s_);
  log_.farm_is_fitted(nodes, hosts_->size());
}

/// Whether there are too few hosts for the farm as it is: then no job begins, as the farm keeps its
/// size while one is on.
bool Frontal::waits_for_hosts() const { return hosts_ && !hosts_->waiting().empty(); }

/// Where a node that says hello should have its local socket; nothing if no host was asked for it.
std::optional<std::string> Frontal::node_folder_of(const control::Hello& m) const {
  if (!hosts_) return options_.node_folder;
  const auto host = hosts_->host_of(Rank{m.rank});
  if (!host) return std::nullopt;
  return hosts_->folder_of(*host);
}

}  // namespace graycube

#include "node/mailroom.hpp"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <utility>

#include "version.hpp"

namespace graycube {
namespace {

/// A program that lies beside this one.
std::filesystem::path program_beside(const char* name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

}  // namespace

std::string inbox_of(const FarmAccess& farm, Rank rank) {
  return "ipc://" + farm.folder + "/node-" + std::to_string(rank.value);
}

Mailroom::Mailroom(const FarmAccess& farm, Rank rank, std::uint32_t incarnation, bool is_guest,
                   TakeIn take_in)
    : keys_(node_pair_of(farm.secret)),
      inbox_(make_inbox(farm, rank)),
      frontal_(connect(farm.frontal)),
      rank_(rank),
      node_({rank_, incarnation, static_cast<std::uint64_t>(::getpid()), inbox_->endpoint(),
             farm.threads, kVersion, inbox_->tcp_endpoint()}),
      pool_(node_, wakeup_, is_guest),
      door_(rank_, farm.secret),
      fifo_(program_beside("graycube-fifo")),
      take_in_(std::move(take_in)) {
  node_.measure = [this, measure = std::move(node_.measure)](control::NodeStats& stats) {
    measure(stats);
    stats.fifo_cpu_s = fifo_.cpu_s();
    stats.cpu_s += stats.fifo_cpu_s;
  };
  Message hello = node_.hello();
  hello.payload = Bytes(farm.secret.begin(), farm.secret.end());
  frontal_.send(std::move(hello));
}

std::unique_ptr<Inbox> Mailroom::make_inbox(const FarmAccess& farm, Rank rank) {
  const std::string local = inbox_of(farm, rank);
  if (farm.address.empty()) return std::make_unique<Inbox>(context_, local);
  doorkeeper_.emplace(context_, admitted_to_nodes(keys_));
  return std::make_unique<Inbox>(context_, local,
                                 KeyedDoor{"tcp://" + farm.address + ":*", keys_, kNodesDomain});
}

/// What stays on this host is plain; what leaves it is encrypted.
Connection Mailroom::connect(const std::string& endpoint) {
  if (!endpoint.starts_with("tcp://")) return {context_, endpoint};
  return {context_, endpoint, access_between_nodes(keys_)};
}

void Mailroom::run() {
  for (;;) {
    const int descriptors[] = {wakeup_.descriptor(), fifo_.descriptor()};
    wait_readable(sockets_, descriptors, std::chrono::seconds(1));
    wakeup_.clear();
    const bool ended = pool_.with_node([&] {
      take_mail();
      outgoing_ = node_.take_outgoing();
      guests_ = node_.take_guests();
      for_fifo_ = node_.take_for_fifo();
      fifo_order_ = node_.fifo_order();
      return node_.is_shut_down();
    });
    // Outside the lock: evaluators never wait for a socket.
    for (Node::Outgoing& o : outgoing_) send(o);
    if (ended) return;
    for (const control::Host& guest : guests_) take_in_(guest);
    serve_fifo();
  }
}

void Mailroom::take_mail() {
  while (auto m = inbox_->receive()) {
    if (door_.lets_in(m->peer, m->message)) node_.on_neighbour(m->message.frame);
  }
  for (auto& [to, link] : links_) {
    while (const auto m = link.connection.receive_view()) node_.on_neighbour(m->frame);
  }
  fifo_.receive([this](std::span<const std::byte> ray) { node_.on_fifo(ray); });
  if (auto why = fifo_.take_failure()) node_.on_fifo_end(*std::move(why));
  while (auto m = frontal_.receive()) node_.on_frontal(*m);
}

void Mailroom::serve_fifo() {
  if (!fifo_.serve(fifo_order_)) wakeup_.signal();
  fifo_.send(for_fifo_);
}

void Mailroom::send(Node::Outgoing& o) {
  if (!o.to) return frontal_.send(std::move(o.message));
  if (!connects_to(rank_, *o.to)) {
    // Whoever has not greeted yet has not begun any job either.
    const std::string* const peer = door_.connection_to(*o.to);
    if (peer != nullptr) inbox_->send(*peer, std::move(o.message));
    return;
  }
  door_.sign(o.message);
  link_to(*o.to).send(std::move(o.message));
}

/// A neighbour that was started again listens at another TCP port, while a local socket keeps its
/// path: a connection to the old place would wait for ever.
Connection& Mailroom::link_to(Rank neighbour) {
  const std::string& endpoint = node_.endpoints()[neighbour.value];
  const auto known = links_.find(neighbour);
  if (known != links_.end() && known->second.endpoint == endpoint) return known->second.connection;
  links_.erase(neighbour);
  Link& link = links_.emplace(neighbour, Link{endpoint, connect(endpoint)}).first->second;
  sockets_ = {inbox_.get(), &frontal_};
  for (auto& [rank, other] : links_) sockets_.push_back(&other.connection);
  return link.connection;
}

}  // namespace graycube

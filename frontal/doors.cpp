#include "frontal/doors.hpp"

#include <unistd.h>

#include <string_view>
#include <utility>

#include "process/accept.hpp"
#include "transport/endpoint.hpp"
#include "transport/farm_key.hpp"

namespace graycube {
namespace {

/// The first letter of a peer's name tells which door it came through: each inbox numbers its own.
constexpr char kNode = 'n', kClient = 'c';

constexpr PeerLimits kClientLimits{kMaxClientFrameBytes, kMaxUnsentAnswers, kMaxUnreadRequests,
                                   kClientHandshake_ms};

std::uint16_t port_of(const std::string& tcp_endpoint) {
  const std::size_t colon = tcp_endpoint.rfind(':');
  return colon == std::string::npos
             ? std::uint16_t{0}
             : static_cast<std::uint16_t>(std::stoi(tcp_endpoint.substr(colon + 1)));
}

}  // namespace

Doors::Doors(const DoorPlaces& places)
    : clients_at_(places.listen.empty() ? "ipc://" + (places.folder / "frontal").string()
                                        : places.listen),
      key_file_(places.key_file),
      is_key_files_owner_(places.key_file.empty()) {
  const bool has_key = needs_key(clients_at_) || !places.address_for_nodes.empty();
  FoundKey found;
  if (has_key) found = find_key(places.folder);
  try {
    if (has_key) {
      keys_ = farm_keys_of(found.farm_key);
      doorkeeper_.emplace(context_, admitted_to_door(*keys_));
    }
    open(places);
    if (key_file_.empty() && has_key) {
      // Only now the port is known, which names the file.
      key_file_ = key_file_of(clients_->endpoint());
      write_farm_key(key_file_, found.farm_key);
    }
  } catch (...) {
    // A key that was there opens a farm that listens there already.
    if (!found.is_in_file) remove_key();
    throw;
  }
}

std::uint16_t Doors::port_for_far_nodes() const { return port_of(for_far_nodes()); }

Doors::~Doors() { remove_key(); }

/// The key of a farm that can name its file lies there before anybody can connect.
FoundKey Doors::find_key(const std::filesystem::path& folder) {
  if (key_file_.empty() && !needs_key(clients_at_)) key_file_ = (folder / "key").string();
  if (key_file_.empty() && !clients_at_.ends_with(":*")) key_file_ = key_file_of(clients_at_);
  if (key_file_.empty()) return {make_secret(), false};
  const FoundKey found = find_farm_key(key_file_);
  if (!found.is_in_file) write_farm_key(key_file_, found.farm_key);
  return found;
}

void Doors::open(const DoorPlaces& places) {
  const std::string nodes_at = "ipc://" + (places.folder / "nodes").string();
  if (places.address_for_nodes.empty()) {
    nodes_.emplace(context_, nodes_at);
  } else {
    const KeyedDoor door{"tcp://" + places.address_for_nodes + ":*", keys_->nodes, kNodesDomain};
    nodes_.emplace(context_, nodes_at, door);
    nodes_->watch_refusals();
  }
  refuse_connections_above(places.others + kMaxClientConnections,
                           {(places.folder / "nodes").string(), port_of(nodes_->tcp_endpoint())});
  if (needs_key(clients_at_)) {
    clients_.emplace(context_, KeyedDoor{clients_at_, keys_->door, kDoorDomain}, kClientLimits);
    clients_->watch_refusals();
  } else {
    clients_.emplace(context_, clients_at_, kClientLimits);
  }
}

void Doors::remove_key() const {
  if (!is_key_files_owner_ || key_file_.empty()) return;
  ::unlink(key_file_.c_str());
  if (std::string_view(key_file_).starts_with(run_folder() + "/")) ::rmdir(run_folder().c_str());
}

std::vector<TurnedAway> Doors::take_refusals() {
  std::vector<TurnedAway> refusals = clients_->take_refusals();
  for (TurnedAway& r : nodes_->take_refusals()) refusals.push_back(std::move(r));
  return refusals;
}

std::uint64_t Doors::take_crowded_out() { return take_refused_connections(); }

std::optional<Doors::Received> Doors::receive() {
  if (const auto m = nodes_->receive()) return Received{kNode + m->peer, m->message};
  if (const auto m = clients_->receive())
    return Received{kClient + m->peer, m->message, m->key == PeerKey::kNode};
  return std::nullopt;
}

void Doors::send(const PeerId& peer, Message message) {
  if (peer.empty()) return;
  (peer.front() == kNode ? *nodes_ : *clients_).send(peer.substr(1), std::move(message));
}

}  // namespace graycube

#include "frontal/doors.hpp"

#include <unistd.h>

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

}  // namespace

Doors::Doors(const std::filesystem::path& folder, const std::string& listen, std::string key_file,
             int others)
    : nodes_(context_, "ipc://" + (folder / "nodes").string()), key_file_(std::move(key_file)) {
  refuse_connections_above(others + kMaxClientConnections, (folder / "nodes").string());
  const std::string endpoint = listen.empty() ? "ipc://" + (folder / "frontal").string() : listen;
  if (!needs_key(endpoint)) {
    key_file_.clear();
    clients_.emplace(context_, endpoint, kClientLimits);
    return;
  }
  clients_.emplace(context_, endpoint, kClientLimits, true);
  // Only now the port is known, which names the file. Until there is a doorkeeper nobody gets in.
  if (key_file_.empty()) key_file_ = key_file_of(clients_->endpoint());
  doorkeeper_.emplace(context_, make_key(key_file_));
}

Doors::~Doors() {
  if (key_file_.empty()) return;
  ::unlink(key_file_.c_str());
  ::rmdir(run_folder().c_str());
}

std::uint64_t Doors::take_crowded_out() { return take_refused_connections(); }

std::optional<Doors::Received> Doors::receive() {
  if (const auto m = nodes_.receive()) return Received{kNode + m->peer, m->message};
  if (const auto m = clients_->receive()) return Received{kClient + m->peer, m->message};
  return std::nullopt;
}

void Doors::send(const PeerId& peer, Message message) {
  if (peer.empty()) return;
  (peer.front() == kNode ? nodes_ : *clients_).send(peer.substr(1), std::move(message));
}

}  // namespace graycube

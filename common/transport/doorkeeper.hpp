// Looks at the keys of those who connect to inboxes at TCP ports, before anything that they send is
// looked at (ZeroMQ's CURVE mechanism, RFC 26, and its authentication protocol, RFC 27).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "transport/curve_keys.hpp"
#include "transport/peer_key.hpp"

namespace graycube {

class ZmqContext;

/// Somebody who is let in at the inboxes of a domain.
struct Admitted {
  std::string domain;
  CurveKey public_key{};
  PeerKey who{};
};

/// A thread that answers for all inboxes of a context that have a TCP port. It must end before the
/// context. As long as there is none nobody gets in.
class Doorkeeper {
 public:
  /// Whoever isn't in the list stays out. Throws TransportError.
  Doorkeeper(ZmqContext& context, std::vector<Admitted> list);
  ~Doorkeeper();
  Doorkeeper(const Doorkeeper&) = delete;
  Doorkeeper& operator=(const Doorkeeper&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Who is let in where: at nodes' inboxes nodes alone, at the door clients and hosts that join.
std::vector<Admitted> admitted_to_nodes(const CurvePair& nodes);
std::vector<Admitted> admitted_to_door(const FarmKeys& keys);

}  // namespace graycube

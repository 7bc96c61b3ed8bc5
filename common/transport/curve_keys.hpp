// The keys of a farm's links over TCP. All are derived from one, the farm's: whoever holds that is
// the farm's user. What is derived doesn't lead back to it, so that a client can be given its own.
#pragma once

#include <array>
#include <cstddef>

#include "transport/secret.hpp"

namespace graycube {

/// A key of CURVE (RFC 26), public or secret: a point or a scalar of Curve25519.
using CurveKey = std::array<std::byte, 32>;

struct CurvePair {
  CurveKey public_key{}, secret_key{};
};

/// What both ends of a connection must agree on. An end shows `own`; the end that connects knows
/// before that the other holds the secret key to `server`.
struct CurveAccess {
  CurvePair own;
  CurveKey server{};
};

struct FarmKeys {
  /// What nodes show in `hello` and greetings.
  Secret node_secret{};
  /// Both ends of a link between nodes hold the first pair: holding it is being a node. Clients
  /// show the second. The frontal's door holds the third.
  CurvePair nodes, clients, door;
};

/// What a client must know: less than it takes to pass for a node or for the frontal.
struct ClientKeys {
  CurveKey client_secret{}, door_public{};
};

FarmKeys farm_keys_of(const Secret& farm_key);
/// Nodes know their secret alone.
CurvePair node_pair_of(const Secret& node_secret);
ClientKeys client_keys_of(const FarmKeys& keys);

/// How a node connects to a node; how a host that joins, and how a client, connects to the door.
CurveAccess access_between_nodes(const CurvePair& nodes);
CurveAccess access_of_node(const FarmKeys& keys);
CurveAccess access_of_client(const ClientKeys& keys);

/// The public key to a secret one.
CurvePair pair_of(const CurveKey& secret_key);

}  // namespace graycube

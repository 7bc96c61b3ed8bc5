// How sockets of ZeroMQ are set up for TCP: with keys, and so that a cut link is noticed.
#pragma once

#include <string>

#include "transport/curve_keys.hpp"
#include "transport/peer_key.hpp"
#include "transport/zmq_context.hpp"

namespace graycube {

/// Said of endpoints that are used otherwise.
inline constexpr const char* kKeysAtTcp = "keys are shown at TCP ports, and only there";

/// A link on which nothing goes is probed after so many seconds, then every kProbeInterval_s; after
/// kProbes without an answer it is lost.
inline constexpr int kIdle_s = 5, kProbeInterval_s = 2, kProbes = 3;
/// A link is lost, too, when for so long nothing that was sent was acknowledged, or the peer,
/// though it lives, has taken nothing of it. ZeroMQ's own heartbeats aren't used: their answers
/// wait behind the message that is under way, and a scene may take longer than any good patience.
inline constexpr int kUnacknowledged_ms = 30'000;

bool is_tcp(const std::string& endpoint);

/// For a socket that is about to connect; throws zmq::error_t.
void make_keyed(zmq::socket_t& socket, const std::string& endpoint, const CurveAccess& access);

/// For a socket that is about to be bound there; throws zmq::error_t.
void make_keyed_door(zmq::socket_t& socket, const KeyedDoor& door);

/// The key that the Doorkeeper knows a message's sender by, kNone for local peers.
PeerKey key_of_sender(const zmq::message_t& received);

/// Names of keys, as the Doorkeeper tells libzmq, which tells key_of_sender().
const char* user_of(PeerKey key);

/// The address, without port, at the other end of a socket; empty if there is none any more.
std::string address_of_peer(int descriptor);

}  // namespace graycube

// Asks those who connect to an inbox for the farm's key, before anything they send is looked at
// (ZeroMQ's PLAIN mechanism, RFC 24, and its authentication protocol, RFC 27).
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace graycube {

class ZmqContext;

/// What a peer shows: PLAIN calls them user name and password.
inline constexpr const char* kKeyUser = "graycube";

/// A thread that answers for all inboxes of a context that want a key. It must end before the
/// context, and begin before the first inbox that wants a key.
class Doorkeeper {
 public:
  /// `key`: 1 to 255 characters. Throws TransportError.
  Doorkeeper(ZmqContext& context, std::string key);
  ~Doorkeeper();
  Doorkeeper(const Doorkeeper&) = delete;
  Doorkeeper& operator=(const Doorkeeper&) = delete;

  /// How often somebody without the key was turned away since this was last asked.
  std::uint64_t take_refused();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace graycube

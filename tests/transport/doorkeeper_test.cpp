#include "transport/doorkeeper.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <optional>
#include <string>

#include "catch.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {
namespace {

using namespace std::chrono_literals;

const std::string kKey(64, 'a');

struct House {
  ZmqContext context;
  Doorkeeper doorkeeper{context, kKey};
  Inbox inbox{context, "tcp://127.0.0.1:*", {.handshake_ms = 300}, true};

  std::optional<std::string> next_text(std::chrono::milliseconds patience) {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < until) {
      if (const auto m = inbox.receive()) return std::string(m->message.text());
      Readable* const sockets[] = {&inbox};
      wait_readable(sockets, {}, 20ms);
    }
    return std::nullopt;
  }
  int port() const { return std::stoi(inbox.endpoint().substr(inbox.endpoint().rfind(':') + 1)); }
};

TEST_CASE("whoever shows the key is let in, and nobody else is heard") {
  House house;
  ZmqContext outside;
  Connection without(outside, house.inbox.endpoint());
  Connection wrong(outside, house.inbox.endpoint(), std::string(64, 'b'));
  Connection shorter(outside, house.inbox.endpoint(), kKey.substr(1));
  for (Connection* stranger : {&without, &wrong, &shorter}) stranger->send(Message::of_text("?"));
  CHECK_FALSE(house.next_text(300ms));
  Connection friendly(outside, house.inbox.endpoint(), kKey);
  friendly.send(Message::of_text("hello"));
  CHECK(house.next_text(10s) == "hello");
  CHECK_FALSE(house.next_text(300ms));
}

/// A connection of something that doesn't know ZeroMQ.
class RawPeer {
 public:
  explicit RawPeer(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<in_port_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
    const timeval patience{10, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  ~RawPeer() { ::close(socket_); }
  RawPeer(const RawPeer&) = delete;
  RawPeer& operator=(const RawPeer&) = delete;
  void say(const std::string& text) const {
    ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
  }
  /// Whether the other side hangs up within a good while.
  bool is_hung_up() const {
    char bytes[256];
    for (;;) {
      const ssize_t got = ::recv(socket_, bytes, sizeof bytes, 0);
      if (got == 0 || (got < 0 && errno == ECONNRESET)) return true;
      if (got < 0) return false;
    }
  }

 private:
  int socket_;
};

TEST_CASE("peers that are silent, or no farm's clients, are hung up on") {
  House house;
  const RawPeer silent(house.port());
  const RawPeer browser(house.port());
  browser.say("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n" + std::string(100, ' '));
  CHECK(silent.is_hung_up());
  CHECK(browser.is_hung_up());
  CHECK_FALSE(house.next_text(100ms));
}

}  // namespace
}  // namespace graycube

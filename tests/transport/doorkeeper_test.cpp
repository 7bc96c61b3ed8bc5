#include "transport/doorkeeper.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "process/temporary_folder.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {
namespace {

using namespace std::chrono_literals;

const FarmKeys kKeys = farm_keys_of(make_secret());
const FarmKeys kOthers = farm_keys_of(make_secret());

CurveAccess client_of(const FarmKeys& keys) { return access_of_client(client_keys_of(keys)); }

/// A door for clients and hosts, and a node's, which has a local socket, too.
struct House {
  TemporaryFolder folder;
  ZmqContext context;
  Doorkeeper doorkeeper{context, admitted_to_door(kKeys)};
  Inbox door{
      context, KeyedDoor{"tcp://127.0.0.1:*", kKeys.door, kDoorDomain}, {.handshake_ms = 300}};
  Inbox node{context, "ipc://" + (folder / "node").string(),
             KeyedDoor{"tcp://127.0.0.1:*", kKeys.nodes, kNodesDomain}};

  House() { door.watch_refusals(); }

  struct Heard {
    std::string text;
    PeerKey key{};
    bool operator==(const Heard&) const = default;
  };
  static std::optional<Heard> next(Inbox& inbox, std::chrono::milliseconds patience) {
    const auto until = std::chrono::steady_clock::now() + patience;
    while (std::chrono::steady_clock::now() < until) {
      if (const auto m = inbox.receive()) return Heard{std::string(m->message.text()), m->key};
      Readable* const sockets[] = {&inbox};
      wait_readable(sockets, {}, 20ms);
    }
    return std::nullopt;
  }
  /// Why the door hung up on the next that it did on.
  std::optional<RefusalReason> next_refusal() {
    const auto until = std::chrono::steady_clock::now() + 10s;
    while (std::chrono::steady_clock::now() < until) {
      if (const auto refusals = door.take_refusals(); !refusals.empty())
        return refusals.front().reason;
      Readable* const sockets[] = {&door};
      wait_readable(sockets, {}, 5ms);
    }
    return std::nullopt;
  }
  int port() const { return std::stoi(door.endpoint().substr(door.endpoint().rfind(':') + 1)); }
};

/// What a connection is told to be wrong, once that is told.
std::optional<HandshakeTrouble> trouble_of(Connection& connection, HandshakeTrouble passing) {
  const auto until = std::chrono::steady_clock::now() + 10s;
  while (std::chrono::steady_clock::now() < until) {
    if (const auto trouble = connection.trouble(); trouble && *trouble != passing) return trouble;
    connection.receive(5ms);
  }
  return std::nullopt;
}
std::optional<HandshakeTrouble> trouble_of(Connection& connection) {
  return trouble_of(connection, HandshakeTrouble::kNobody);
}

TEST_CASE("clients and nodes come in with their keys, and the inbox tells which it was") {
  House house;
  ZmqContext outside;
  Connection client(outside, house.door.endpoint(), client_of(kKeys), Watch::kYes);
  client.send(Message::of_text("a client"));
  CHECK(House::next(house.door, 10s) == House::Heard{"a client", PeerKey::kClient});
  CHECK_FALSE(client.trouble());
  Connection host(outside, house.door.endpoint(), access_of_node(kKeys));
  host.send(Message::of_text("a host"));
  CHECK(House::next(house.door, 10s) == House::Heard{"a host", PeerKey::kNode});
  Connection node(outside, house.node.tcp_endpoint(), access_between_nodes(kKeys.nodes));
  node.send(Message::of_text("a node"));
  CHECK(House::next(house.node, 10s) == House::Heard{"a node", PeerKey::kNode});
  Connection local(outside, house.node.endpoint());
  local.send(Message::of_text("a process of this user"));
  CHECK(House::next(house.node, 10s) == House::Heard{"a process of this user", PeerKey::kNone});
}

TEST_CASE("a client's key opens no node's door") {
  House house;
  ZmqContext outside;
  Connection client(outside, house.node.tcp_endpoint(),
                    CurveAccess{kKeys.clients, kKeys.nodes.public_key}, Watch::kYes);
  client.send(Message::of_text("I am a node"));
  CHECK(trouble_of(client) == HandshakeTrouble::kNotAdmitted);
  CHECK_FALSE(House::next(house.node, 200ms));
}

TEST_CASE("who shows another key is turned away, and both ends are told") {
  House house;
  ZmqContext outside;
  CurveAccess access = client_of(kKeys);
  access.own = kOthers.clients;
  Connection stranger(outside, house.door.endpoint(), access, Watch::kYes);
  stranger.send(Message::of_text("?"));
  CHECK(trouble_of(stranger) == HandshakeTrouble::kNotAdmitted);
  CHECK(house.next_refusal() == RefusalReason::kWrongKey);
  CHECK_FALSE(House::next(house.door, 200ms));
  CHECK_FALSE(stranger.is_lost());
}

TEST_CASE("who takes it for another farm is hung up on, and both ends are told") {
  House house;
  ZmqContext outside;
  Connection stranger(outside, house.door.endpoint(), client_of(kOthers), Watch::kYes);
  stranger.send(Message::of_text("?"));
  CHECK(trouble_of(stranger) == HandshakeTrouble::kHangsUp);
  CHECK(house.next_refusal() == RefusalReason::kWrongKey);
  CHECK_FALSE(House::next(house.door, 200ms));
}

TEST_CASE("without a doorkeeper nobody gets in") {
  ZmqContext context, outside;
  Inbox inbox(context, KeyedDoor{"tcp://127.0.0.1:*", kKeys.door, kDoorDomain});
  Connection client(outside, inbox.endpoint(), client_of(kKeys));
  client.send(Message::of_text("?"));
  CHECK_FALSE(House::next(inbox, 300ms));
}

TEST_CASE("nothing is sent over TCP without keys, and no keys are shown elsewhere") {
  const TemporaryFolder folder;
  ZmqContext context;
  const std::string local = "ipc://" + (folder / "inbox").string(), tcp = "tcp://127.0.0.1:5555";
  CHECK_THROWS_AS(Connection(context, tcp), TransportError);
  CHECK_THROWS_AS(Connection(context, local, client_of(kKeys)), TransportError);
  CHECK_THROWS_AS(Inbox(context, "tcp://127.0.0.1:*"), TransportError);
  CHECK_THROWS_AS(Inbox(context, KeyedDoor{local, kKeys.door, kDoorDomain}), TransportError);
}

TEST_CASE("a connection tells that nobody listens, until somebody does") {
  ZmqContext context, outside;
  std::string endpoint;
  {
    const Inbox inbox(context, KeyedDoor{"tcp://127.0.0.1:*", kKeys.door, kDoorDomain});
    endpoint = inbox.endpoint();
  }
  Connection client(outside, endpoint, client_of(kKeys), Watch::kYes);
  client.send(Message::of_text("hello"));
  CHECK_FALSE(client.receive(300ms));
  CHECK(client.trouble() == HandshakeTrouble::kNobody);
  const Doorkeeper doorkeeper(context, admitted_to_door(kKeys));
  Inbox inbox(context, KeyedDoor{endpoint, kKeys.door, kDoorDomain});
  CHECK(House::next(inbox, 10s) == House::Heard{"hello", PeerKey::kClient});
  CHECK_FALSE(client.trouble());
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

TEST_CASE("peers that are silent, or no farm's clients, are hung up on, and it is told why") {
  House house;
  {
    const RawPeer browser(house.port());
    browser.say("GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n" + std::string(100, ' '));
    CHECK(browser.is_hung_up());
    CHECK(house.next_refusal() == RefusalReason::kNotZmq);
  }
  {
    const RawPeer silent(house.port());
    CHECK(silent.is_hung_up());
    CHECK(house.next_refusal() == RefusalReason::kSilent);
  }
  {
    // ZeroMQ's greeting for the mechanism NULL, which needs no key.
    const RawPeer plain(house.port());
    plain.say(std::string("\xff\0\0\0\0\0\0\0\1\x7f\3\0NULL", 16) + std::string(48, '\0'));
    CHECK(plain.is_hung_up());
    CHECK(house.next_refusal() == RefusalReason::kNoKey);
  }
  CHECK_FALSE(House::next(house.door, 100ms));
}

/// Listens, and says the same to everybody.
class RawListener {
 public:
  explicit RawListener(std::string text)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)), text_(std::move(text)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const generic = reinterpret_cast<sockaddr*>(&address);
    REQUIRE(::bind(socket_, generic, size) == 0);
    REQUIRE(::getsockname(socket_, generic, &size) == 0);
    REQUIRE(::listen(socket_, 8) == 0);
    endpoint_ = "tcp://127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    thread_ = std::thread([this] { run(); });
  }
  ~RawListener() {
    ::shutdown(socket_, SHUT_RDWR);
    thread_.join();
    ::close(socket_);
  }
  RawListener(const RawListener&) = delete;
  RawListener& operator=(const RawListener&) = delete;
  const std::string& endpoint() const { return endpoint_; }

 private:
  void run() {
    std::vector<int> peers;
    for (int peer = 0; (peer = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC)) >= 0;) {
      ::send(peer, text_.data(), text_.size(), MSG_NOSIGNAL);
      peers.push_back(peer);
    }
    for (const int peer : peers) ::close(peer);
  }
  int socket_;
  std::string text_, endpoint_;
  std::thread thread_;
};

TEST_CASE("a connection tells what listens there instead of a farm") {
  ZmqContext context;
  const std::string plain =
      std::string("\xff\0\0\0\0\0\0\0\1\x7f\3\0NULL", 16) + std::string(48, '\0');
  for (const auto& [said, trouble] : {std::pair<std::string, HandshakeTrouble>{
                                          "SSH-2.0-OpenSSH_9.2\r\n", HandshakeTrouble::kNotZmq},
                                      {plain, HandshakeTrouble::kOtherMechanism},
                                      {"", HandshakeTrouble::kSilent}}) {
    const RawListener listener(said);
    Connection client(context, listener.endpoint(), client_of(kKeys), Watch::kYes);
    CHECK(trouble_of(client) == trouble);
  }
}

}  // namespace
}  // namespace graycube

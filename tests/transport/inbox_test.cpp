#include <sys/stat.h>

#include <string>

#include "catch.hpp"
#include "process/temporary_folder.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {
namespace {

using namespace std::chrono_literals;

/// The next message that comes to an inbox within a good while.
std::optional<std::string> next_text(Inbox& inbox, std::string* peer = nullptr,
                                     std::chrono::milliseconds patience = 10s) {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (std::chrono::steady_clock::now() < until) {
    if (const auto m = inbox.receive()) {
      if (peer != nullptr) *peer = m->peer;
      return std::string(m->message.text());
    }
    Readable* const sockets[] = {&inbox};
    wait_readable(sockets, {}, 20ms);
  }
  return std::nullopt;
}

TEST_CASE("a local inbox is its owner's alone, whatever the umask") {
  const TemporaryFolder folder;
  ZmqContext context;
  const mode_t before = ::umask(0);
  const Inbox inbox(context, "ipc://" + (folder / "inbox").string());
  CHECK(::umask(before) == 0);
  struct stat status {};
  REQUIRE(::lstat((folder / "inbox").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0600);
}

TEST_CASE("a peer that sends longer frames than it may is disconnected, and others are heard") {
  const TemporaryFolder folder;
  ZmqContext context;
  Inbox inbox(context, "ipc://" + (folder / "inbox").string(), {.frame_bytes = 1000});
  Connection long_winded(context, inbox.endpoint()), brief(context, inbox.endpoint());
  long_winded.send(Message::of_text(std::string(1001, 'x')));
  brief.send(Message::of_text(std::string(1000, 'y')));
  CHECK(next_text(inbox) == std::string(1000, 'y'));
  CHECK_FALSE(next_text(inbox, nullptr, 200ms));
}

TEST_CASE(
    "answers that a peer doesn't read are dropped past a limit, and all memory is kept small") {
  const TemporaryFolder folder;
  ZmqContext context;
  constexpr int kMost = 4;
  Inbox inbox(context, "ipc://" + (folder / "inbox").string(), {.unsent = kMost});
  Connection lazy(context, inbox.endpoint());
  lazy.send(Message::of_text("hear me"));
  std::string peer;
  REQUIRE(next_text(inbox, &peer) == "hear me");
  // More than its own queue and the system's buffers hold: that has no limit, but it doesn't grow
  // unless its thread reads what lies in the buffers.
  constexpr int kSent = 400;
  for (int i = 0; i < kSent; ++i) inbox.send(peer, Message::of_text(std::string(1 << 20, 'z')));
  int came = 0;
  while (lazy.receive(300ms)) ++came;
  CHECK(came >= kMost);
  CHECK(came < kSent);
}

}  // namespace
}  // namespace graycube

// graycube-fifo PLACES: holds a node's FIFO of received rays, apart from the node as in 1987.
// Started by graycube-node, which is at the other end of standard input: a socket, both ways.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>

#include "node/parts/fifo/ray_fifo.hpp"
#include "proto/messages/values.hpp"
#include "version.hpp"

namespace graycube {
namespace {

constexpr int kDone = 0, kFailed = 1, kUsage = 2;
/// Bytes that are read at once.
constexpr std::size_t kReadBytes = std::size_t{1} << 16;

int fail(std::string_view why, int status) {
  std::fprintf(stderr, "graycube-fifo: %.*s\n", static_cast<int>(why.size()), why.data());
  return status;
}

std::optional<std::size_t> places_in(std::string_view text) {
  std::size_t places = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), places);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  if (places == 0 || places > kMaxQueue) return std::nullopt;
  return places;
}

/// False when the node has gone.
bool write_all(const Bytes& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count =
        ::send(STDIN_FILENO, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR) return false;
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
  return true;
}

/// Serves the node until it closes its end, as it also does when it is killed.
int serve(std::size_t places) {
  RayFifo fifo(places);
  Bytes answers;
  std::array<std::byte, kReadBytes> part;
  for (;;) {
    const ssize_t count = ::read(STDIN_FILENO, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return fail(std::strerror(errno), kFailed);
    if (count == 0) return kDone;
    answers.clear();
    const auto wrong = fifo.take(std::span(part).first(static_cast<std::size_t>(count)), answers);
    if (wrong) return fail(*wrong, kFailed);
    if (!write_all(answers)) return kDone;
  }
}

int run_main(int argc, char** argv) {
  const std::string_view argument = argc == 2 ? argv[1] : "";
  if (argument == "--version") {
    std::printf("graycube-fifo %s\n", kVersion);
    return kDone;
  }
  const auto places = places_in(argument);
  if (!places) return fail("usage: graycube-fifo PLACES, as graycube-node calls it", kUsage);
  // It never outlives its node, not even while it is stopped.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  return serve(*places);
}

}  // namespace
}  // namespace graycube

int main(int argc, char** argv) { return graycube::run_main(argc, argv); }

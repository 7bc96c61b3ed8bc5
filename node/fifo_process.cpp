#include "node/fifo_process.hpp"

#include <signal.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include "check.hpp"
#include "process/clocks.hpp"
#include "process/spawn_plan.hpp"

namespace graycube {
namespace {

/// Bytes that are read at once.
constexpr std::size_t kReadBytes = std::size_t{1} << 14;

bool is_for_later(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR || error == ENOBUFS;
}

}  // namespace

FifoProcess::FifoProcess(std::filesystem::path program)
    : program_(std::move(program)), descriptor_(::epoll_create1(EPOLL_CLOEXEC)) {
  GRAYCUBE_CHECK(descriptor_ >= 0, "epoll_create1: %s", std::strerror(errno));
}

FifoProcess::~FifoProcess() {
  end();
  ::close(descriptor_);
}

bool FifoProcess::serve(const std::optional<FifoOrder>& order) {
  if (order == order_) return true;
  end();
  failure_.reset();
  order_ = order;
  if (order_) start();
  return !failure_;
}

void FifoProcess::start() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return fail(std::strerror(errno));
  SpawnPlan plan;
  plan.pass_as(STDIN_FILENO, ends[1]);
  const int error = plan.spawn(pid_, {program_.string(), std::to_string(order_->places)});
  ::close(ends[1]);
  if (error != 0) {
    ::close(ends[0]);
    pid_ = -1;
    return fail(program_.string() + ": " + std::strerror(error));
  }
  socket_ = ends[0];
  watch();
}

/// Tells epoll what to wait for.
void FifoProcess::watch() {
  epoll_event event{};
  event.events = EPOLLIN | (waits_for_room_ ? EPOLLOUT : 0u);
  if (::epoll_ctl(descriptor_, EPOLL_CTL_MOD, socket_, &event) != 0)
    ::epoll_ctl(descriptor_, EPOLL_CTL_ADD, socket_, &event);
}

void FifoProcess::end() {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  if (pid_ >= 0) {
    ::kill(pid_, SIGKILL);
    wait_for_end(std::exchange(pid_, -1));
  }
  stream_ = {};
  unsent_.clear();
  waits_for_room_ = false;
}

void FifoProcess::fail(const std::string& why) {
  failure_ = "FIFO: " + why;
  end();
}

/// The process has closed its end of the sockets: it has ended, or is about to. Then a signal comes
/// too late to change how.
void FifoProcess::note_end() {
  ::kill(pid_, SIGKILL);
  const pid_t pid = std::exchange(pid_, -1);
  failure_ = "FIFO (process " + std::to_string(pid) + "): " + how_it_ended(wait_for_end(pid));
  end();
}

std::optional<std::string> FifoProcess::take_failure() { return std::exchange(failure_, {}); }

void FifoProcess::send(const std::vector<Bytes>& messages) {
  if (socket_ < 0) return;
  for (const Bytes& m : messages) unsent_.insert(unsent_.end(), m.begin(), m.end());
  write();
}

void FifoProcess::write() {
  std::size_t sent = 0;
  while (sent < unsent_.size()) {
    const ssize_t count =
        ::send(socket_, unsent_.data() + sent, unsent_.size() - sent, MSG_DONTWAIT | MSG_NOSIGNAL);
    // If the process has ended, receive() finds out how.
    if (count < 0) break;
    sent += static_cast<std::size_t>(count);
  }
  unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(sent));
  if (waits_for_room_ == unsent_.empty()) {
    waits_for_room_ = !unsent_.empty();
    watch();
  }
}

void FifoProcess::receive(const std::function<void(std::span<const std::byte>)>& on_ray) {
  if (socket_ < 0) return;
  if (waits_for_room_) write();
  std::array<std::byte, kReadBytes> part;
  const ssize_t count = ::recv(socket_, part.data(), part.size(), MSG_DONTWAIT);
  if (count < 0 && is_for_later(errno)) return;
  if (count <= 0) return note_end();
  bool are_rays = true;
  const bool are_messages = stream_.take(std::span(part).first(static_cast<std::size_t>(count)),
                                         [&](FifoWord word, std::span<const std::byte> ray) {
                                           are_rays = are_rays && word == FifoWord::kHand;
                                           if (are_rays) on_ray(ray);
                                         });
  if (!are_messages || !are_rays) fail("what came from its process is no ray");
}

double FifoProcess::cpu_s() const {
  clockid_t clock{};
  return pid_ >= 0 && ::clock_getcpuclockid(pid_, &clock) == 0 ? seconds_of(clock) : 0;
}

}  // namespace graycube

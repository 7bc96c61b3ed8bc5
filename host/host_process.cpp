#include "host/host_process.hpp"

#include <signal.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <system_error>

#include "process/clocks.hpp"
#include "process/temporary_folder.hpp"
#include "proto/control.hpp"
#include "transport/own_address.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {
namespace {

constexpr auto kTick = std::chrono::milliseconds(50);

/// The same host, at another port.
std::string with_port(const std::string& endpoint, std::uint32_t port) {
  return endpoint.substr(0, endpoint.rfind(':') + 1) + std::to_string(port);
}

class Signals {
 public:
  Signals() {
    sigset_t set;
    ::sigemptyset(&set);
    for (const int s : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) ::sigaddset(&set, s);
    ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
    descriptor_ = ::signalfd(-1, &set, SFD_NONBLOCK | SFD_CLOEXEC);
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
  }
  ~Signals() { ::close(descriptor_); }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  int descriptor() const { return descriptor_; }
  /// Whether one has come that asks for the end; SIGCHLD only wakes the loop.
  bool take_end() {
    bool is_asked = false;
    signalfd_siginfo info{};
    while (::read(descriptor_, &info, sizeof info) == sizeof info)
      is_asked = is_asked || info.ssi_signo != SIGCHLD;
    return is_asked;
  }

 private:
  int descriptor_ = -1;
};

class HostProcess {
 public:
  explicit HostProcess(const HostSetting& s)
      : setting_(s),
        processes_(s.node_program, folder_.path(), s.keys.node_secret),
        host_(about(), seconds_of(CLOCK_MONOTONIC)) {
    connect();
  }

  std::string run() {
    while (host_.state() != Host::State::kOver) {
      take_events();
      give_orders();
      Readable* const sockets[] = {&*frontal_};
      const int descriptors[] = {signals_.descriptor()};
      wait_readable(sockets, descriptors, kTick);
    }
    give_orders();
    return host_.failure();
  }

 private:
  control::Join about() const {
    control::Join about = setting_.about;
    about.folder = folder_.path().string();
    return about;
  }

  void connect() {
    frontal_.emplace(context_, setting_.endpoint, access_of_node(setting_.keys), Watch::kYes);
  }

  void take_events() {
    const double now_s = seconds_of(CLOCK_MONOTONIC);
    host_.on_time(now_s, !processes_.empty());
    if (signals_.take_end()) host_.leave(now_s);
    for (const NodeExit& exit : processes_.reap()) host_.on_exit(exit);
    while (const auto message = frontal_->receive()) {
      const auto decoded = decode(message->text());
      if (const auto* m = std::get_if<ControlMessage>(&decoded)) host_.on_message(*m, now_s);
    }
    if (host_.state() == Host::State::kJoining) look_for_trouble();
    if (const auto ping = host_.take_ping()) host_.answer_ping(*ping, processes_.stopped());
    tell_of_joining();
  }

  /// A frontal that isn't there yet may come; one that has another key stays wrong.
  void look_for_trouble() {
    const auto trouble = frontal_->trouble();
    if (!trouble || *trouble == HandshakeTrouble::kSilent) return;
    if (*trouble != HandshakeTrouble::kNobody) return host_.give_up(sentence_of(*trouble));
    if (std::exchange(has_told_of_nobody_, true) || host_.farm()) return;
    tell(std::string(sentence_of(*trouble)) + "; waiting for it for up to " +
         std::to_string(static_cast<int>(kFirstJoin_s)) + " s");
  }

  void tell_of_joining() {
    const bool is_joined = host_.state() == Host::State::kJoined;
    if (is_joined == was_joined_) return;
    was_joined_ = is_joined;
    if (is_joined) tell("joined, with room for " + std::to_string(setting_.about.slots) + " nodes");
    if (host_.state() == Host::State::kJoining) tell("the frontal fell silent; looking for it");
  }

  void tell(const std::string& what) const {
    std::fprintf(stderr, "graycube: join: %s: %s\n", setting_.endpoint.c_str(), what.c_str());
  }

  void give_orders() {
    if (host_.take_kill_all()) processes_.end_all();
    for (const NodeStart& node : host_.take_kills()) processes_.end(node);
    if (host_.take_reconnect()) connect();
    if (host_.state() == Host::State::kJoined) {
      processes_.start(host_.take_starts(),
                       {with_port(setting_.endpoint, host_.farm()->nodes_port),
                        host_.farm()->threads, address()},
                       seconds_of(CLOCK_MONOTONIC));
    }
    for (const ControlMessage& message : host_.take_outgoing())
      frontal_->send(Message::of_text(encode(message)));
  }

  std::string address() const {
    return setting_.address.empty() ? own_address_towards(setting_.endpoint) : setting_.address;
  }

  const HostSetting& setting_;
  Signals signals_;
  TemporaryFolder folder_;
  ZmqContext context_;
  std::optional<Connection> frontal_;
  NodeProcesses processes_;
  Host host_;
  bool has_told_of_nobody_ = false, was_joined_ = false;
};

}  // namespace

std::string run_host(const HostSetting& setting) { return HostProcess(setting).run(); }

}  // namespace graycube

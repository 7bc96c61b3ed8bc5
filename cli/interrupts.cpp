#include "cli/interrupts.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>

#include "check.hpp"
#include "cli/failure.hpp"

namespace graycube {
namespace {

std::atomic<int> noted{0};
std::atomic<int> holders{0};
std::atomic<int> companions{0};
std::atomic<bool> has_terminal_line{false};
std::array<int, 2> wakeup{-1, -1};
const char* command = "";
static_assert(std::atomic<int>::is_always_lock_free);

const char* reason(int signal) {
  switch (signal) {
    case SIGINT: return "SIGINT: interrupted";
    case SIGTERM: return "SIGTERM: told to stop";
    case SIGHUP: return "SIGHUP: the terminal has gone";
    case SIGALRM: return "--timeout: it did not end in time";
    default: return "signal: told to stop";
  }
}

void write_text(const char* text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text));
}

/// Ends the process by the signal's default action; that of the time limit's doesn't suit.
void die_of(int signal) {
  if (signal == SIGALRM) return;
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(signal, &action, nullptr);
  sigset_t only;
  ::sigemptyset(&only);
  ::sigaddset(&only, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  ::raise(signal);
}

/// Stops this process and its companions; goes on when it is continued.
void on_stop(int) {
  const int saved_errno = errno;
  const int group = companions.load();
  if (group > 0) ::kill(-group, SIGSTOP);
  ::raise(SIGSTOP);
  if (group > 0) ::kill(-group, SIGCONT);
  errno = saved_errno;
}

/// Calls only functions that a signal handler may call.
void on_signal(int signal) {
  const int saved_errno = errno;
  if (signal != SIGCHLD) {
    if (holders.load() == 0) {
      if (has_terminal_line.load()) write_text("\r\x1b[K");
      write_text("graycube: ");
      write_text(command);
      write_text(": ");
      write_text(reason(signal));
      write_text("\n");
      die_of(signal);
      ::_exit(static_cast<int>(ExitStatus::kFailed));
    }
    int none = 0;
    noted.compare_exchange_strong(none, signal);
  }
  const char byte = 0;
  [[maybe_unused]] const auto written = ::write(wakeup[1], &byte, 1);
  errno = saved_errno;
}

void set_timer(double seconds) {
  itimerval timer{};
  const double whole = std::floor(seconds);
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - whole) * 1e6);
  // A limit below the clock's step would switch the timer off.
  if (timer.it_value.tv_sec == 0 && timer.it_value.tv_usec == 0) timer.it_value.tv_usec = 1;
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

}  // namespace

void catch_interrupts(const char* what, double timeout_s) {
  command = what;
  GRAYCUBE_CHECK(::pipe2(wakeup.data(), O_CLOEXEC | O_NONBLOCK) == 0, "pipe2 failed");
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  ::sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM, SIGCHLD}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    // nohup wants SIGHUP to be ignored.
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) continue;
    ::sigaction(signal, &action, nullptr);
  }
  ::signal(SIGPIPE, SIG_IGN);
  if (timeout_s > 0) set_timer(timeout_s);
}

InterruptsHeld::InterruptsHeld() { holders.fetch_add(1); }
InterruptsHeld::~InterruptsHeld() { holders.fetch_sub(1); }

bool is_interrupted() { return noted.load() != 0; }

void throw_if_interrupted() {
  if (const int signal = noted.load(); signal != 0) {
    throw Failure(ExitStatus::kFailed, Problem{command, "", reason(signal)});
  }
}

int noted_interrupt() { return noted.load(); }
void forget_interrupt() { noted.store(0); }
void note_interrupt(int signal) { noted.store(signal); }

void die_of_interrupt() {
  const int signal = noted.load();
  if (signal != 0) die_of(signal);
}

void stop_together_with(int process_group) {
  companions.store(process_group);
  if (process_group == 0) return;
  struct sigaction before {};
  ::sigaction(SIGTSTP, nullptr, &before);
  // A shell without job control wants it to be ignored.
  if (before.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = on_stop;
  action.sa_flags = SA_RESTART;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGTSTP, &action, nullptr);
}

void note_terminal_line(bool is_open) { has_terminal_line.store(is_open); }

int wakeup_descriptor() { return wakeup[0]; }

void clear_wakeup() {
  std::array<char, 64> bytes;
  while (::read(wakeup[0], bytes.data(), bytes.size()) > 0) {
  }
}

}  // namespace graycube

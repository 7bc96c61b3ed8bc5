#include "cli/farm/supervised_frontal.hpp"

#include <poll.h>

#include <chrono>
#include <utility>

#include "cli/farm/listener.hpp"
#include "cli/interrupts.hpp"
#include "process/clocks.hpp"
#include "process/log_line.hpp"

namespace graycube {
namespace {

constexpr std::chrono::milliseconds kWatchInterval{500};
/// A frontal that is stopped for so long is killed.
constexpr std::chrono::seconds kStopPatience{2};

/// HOST:PORT of http://HOST:PORT/.
std::string address_of(const std::string& page) {
  const std::string scheme = "http://";
  const std::string rest = page.starts_with(scheme) ? page.substr(scheme.size()) : page;
  return rest.substr(0, rest.find('/'));
}

}  // namespace

SupervisedFrontal::SupervisedFrontal(std::vector<std::string> arguments, std::string endpoint,
                                     std::string http, LogFile* log)
    : arguments_(std::move(arguments)),
      endpoint_(std::move(endpoint)),
      http_(std::move(http)),
      log_(log) {
  start(false);
}

void SupervisedFrontal::start(bool is_again) {
  std::vector<std::string> arguments = arguments_;
  arguments.insert(arguments.end(), {"--listen", endpoint_});
  if (!http_.empty()) arguments.insert(arguments.end(), {"--http", http_});
  if (is_again) arguments.push_back("--again");
  frontal_ = std::make_unique<FrontalProcess>(arguments);
  endpoint_ = frontal_->wait_until_listening();
  if (!http_.empty()) http_ = address_of(frontal_->page());
}

void SupervisedFrontal::tell(const std::string& what) {
  print({"farm", "graycube-frontal", what});
  note(what);
}

/// The log's own trouble is told by the frontal.
void SupervisedFrontal::note(const std::string& what) {
  if (log_ != nullptr)
    log_->append(log_line(seconds_of(CLOCK_REALTIME), "farm: graycube-frontal: " + what));
}

void SupervisedFrontal::start_again() {
  const std::string how = "killed by signal " + std::to_string(frontal_->death_signal());
  if (!restarts_.allows(std::chrono::steady_clock::now())) {
    const std::string why = how + "; it has been started again " + std::to_string(kMaxRestarts) +
                            " times within " + std::to_string(kRestartSpan.count()) +
                            " s, so the farm ends";
    note(why);
    throw Failure(ExitStatus::kFailed, Problem{"farm", "graycube-frontal", why});
  }
  tell(how + "; it is started again");
  frontal_.reset();  // clears away what it has left: its nodes, its sockets
  remove_stale_socket(endpoint_);
  start(true);
}

/// Whoever stops a frontal stops its farm. Left alone it might never be let go on.
void SupervisedFrontal::kill_if_stopped() {
  const auto now = std::chrono::steady_clock::now();
  if (!frontal_->is_stopped()) {
    stopped_since_.reset();
  } else if (!stopped_since_) {
    stopped_since_ = now;
  } else if (now - *stopped_since_ > kStopPatience) {
    tell("stopped for " + std::to_string(kStopPatience.count()) + " s; it is killed");
    frontal_->kill();
    stopped_since_.reset();
  }
}

void SupervisedFrontal::run() {
  while (!is_interrupted()) {
    if (frontal_->has_ended()) {
      if (frontal_->death_signal() == 0) {
        if (frontal_->exit_status() != 0) frontal_->check_running();
        return;
      }
      start_again();
    }
    kill_if_stopped();
    pollfd wait{wakeup_descriptor(), POLLIN, 0};
    ::poll(&wait, 1, static_cast<int>(kWatchInterval.count()));
    clear_wakeup();
  }
}

}  // namespace graycube

// A farm's frontal under supervision: when it dies, another one is started in its place.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/failure.hpp"
#include "cli/farm/frontal_process.hpp"
#include "cli/farm/restart_limit.hpp"
#include "process/log_file.hpp"

namespace graycube {

class SupervisedFrontal {
 public:
  /// Starts a frontal that is to listen at `endpoint` and, unless it is empty, have its web page at
  /// `http`; `arguments` are all others. Returns once it listens. `log` is told of its ends, too,
  /// unless it is null. Throws a Failure.
  SupervisedFrontal(std::vector<std::string> arguments, std::string endpoint, std::string http,
                    LogFile* log);

  /// Where it listens, and its web page's address or nothing. Another frontal has the same, with
  /// the ports that the first one has picked.
  const std::string& endpoint() const { return endpoint_; }
  const std::string& page() const { return frontal_->page(); }
  /// As of FrontalProcess. Another frontal has another token.
  const std::string& token() const { return frontal_->token(); }
  const std::string& key_file() const { return frontal_->key_file(); }

  /// Waits until the frontal has ended by itself. One that died, by a signal, is started again, and
  /// that is said. Returns early when an interrupt comes. Throws a Failure when it has ended for a
  /// reason, or has died too often.
  void run();
  void stop() noexcept { frontal_->stop(); }

 private:
  void start(bool is_again);
  /// On standard error and in the log; or in the log alone.
  void tell(const std::string& what);
  void note(const std::string& what);
  void start_again();
  void kill_if_stopped();

  std::vector<std::string> arguments_;
  std::string endpoint_, http_;
  LogFile* log_;
  RestartLimit restarts_;
  std::optional<std::chrono::steady_clock::time_point> stopped_since_;
  std::unique_ptr<FrontalProcess> frontal_;
};

}  // namespace graycube

// Which hosts of an allocation of Slurm want a step that joins them to the farm: one for each host,
// again when it has ended. Knows no processes.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace graycube::slurm {

/// Seconds after which a step that ended is started again: so many at first, twice as many after
/// each failure in a row, and no more than so many.
inline constexpr double kFirstPause_s = 1, kLongestPause_s = 60;
/// Hosts that an earlier frontal had joined may come back by themselves within so many seconds.
inline constexpr double kComeBack_s = 2;
/// A step whose host hasn't joined so many seconds after its start is ended: the host may be gone
/// without Slurm knowing it yet.
inline constexpr double kJoinPatience_s = 30;

class Steps {
 public:
  /// `waits`: hosts may come back by themselves, as the farm was there before.
  Steps(const std::vector<std::string>& hosts, bool waits, double now_s);

  /// The hosts for which steps are to be started; `here`: names of those that have joined.
  std::vector<std::string> take_starts(const std::set<std::string>& here, double now_s);
  /// The hosts whose steps are to be ended, as they don't bring them.
  std::vector<std::string> take_ends(const std::set<std::string>& here, double now_s);
  /// The host's step has ended, or couldn't be started. Returns a sentence for people.
  std::string ended(const std::string& host, const std::string& how, double now_s);

 private:
  struct Step {
    std::string host;
    bool is_running = false, is_ending = false, has_joined = false;
    double started_s = 0, next_s = 0;
    unsigned failures = 0;
  };

  std::vector<Step> steps_;
};

}  // namespace graycube::slurm

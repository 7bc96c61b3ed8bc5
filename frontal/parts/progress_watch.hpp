// Notices for how long a job hasn't got on, and says what it waits for.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

#include "frontal/parts/running_job.hpp"

namespace graycube {

class ProgressWatch {
 public:
  static constexpr double kFirstTold_s = 30;

  /// How far the job is; to be called now and then, and when it is asked for.
  void see(const control::JobInfo& job, JobStage stage, double now_s) {
    const std::array<std::uint64_t, 4> state{job.job, static_cast<std::uint64_t>(stage),
                                             job.tiles_whole, job.rounds};
    if (state == state_) return;
    state_ = state;
    since_s_ = now_s;
    told_after_s_ = kFirstTold_s;
  }

  /// Whether the job hasn't got on for so long that it is to be told: after kFirstTold_s, and then
  /// each time that it has lasted twice as long.
  bool take_stands(double now_s) {
    if (now_s - since_s_ < told_after_s_) return false;
    told_after_s_ *= 2;
    return true;
  }

  /// For people: "the nodes' parts of the scene to be subdivided, for 3.2 s".
  std::string waits_for(const control::JobInfo& job, JobStage stage, double now_s) const {
    std::array<char, 32> seconds{};
    std::snprintf(seconds.data(), seconds.size(), ", for %.1f s", std::max(0.0, now_s - since_s_));
    return what(job, stage) + seconds.data();
  }

 private:
  static std::string what(const control::JobInfo& job, JobStage stage) {
    switch (stage) {
      case JobStage::kPreparing: return "its scene to be read and cut";
      case JobStage::kPrepared: return "all nodes to be started";
      case JobStage::kBuilding: return "the nodes' parts of the scene to be subdivided";
      case JobStage::kRendering: break;
      case JobStage::kReporting: return "the nodes' reports";
    }
    if (job.tiles_whole == job.tiles) return "the nodes' verdict that all is done";
    return "the light of " + std::to_string(job.tiles - job.tiles_whole) + " of " +
           std::to_string(job.tiles) + " tiles";
  }

  std::array<std::uint64_t, 4> state_{};
  double since_s_ = 0, told_after_s_ = kFirstTold_s;
};

}  // namespace graycube

// Counts the rays that come to a node, and what tracing did, for its report.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "node/work.hpp"
#include "proto/messages.hpp"
#include "proto/messages/search_report.hpp"

namespace graycube {

class Tally {
 public:
  void add(const Step& step, const WalkCounts& walk) {
    traced_.add(step.rays);
    walk_.add(walk);
    non_finite_ += step.rounding.non_finite;
    clamped_ += step.rounding.clamped;
  }
  void rays_came(std::size_t rays) { rays_in_ += rays; }
  /// Notes how many rays that came across links are here now; the report has the largest number.
  void note_queue(std::size_t rays) { queue_peak_ = std::max<std::uint64_t>(queue_peak_, rays); }

  void report(control::NodeStats& stats) const {
    stats.rays_in = rays_in_;
    stats.queue_peak = queue_peak_;
    stats.primary = created(RayKind::kPrimary);
    stats.shadow = created(RayKind::kShadow);
    stats.reflection = created(RayKind::kReflection);
    stats.refraction = created(RayKind::kRefraction);
    stats.skipped_by_horizon = traced_.skipped_by_horizon;
    stats.non_finite = non_finite_;
    stats.clamped = clamped_;
    report_search(walk_, stats);
  }

 private:
  std::uint64_t created(RayKind kind) const {
    return traced_.created[static_cast<std::size_t>(kind)];
  }

  RayCounts traced_;
  WalkCounts walk_;
  std::uint64_t non_finite_ = 0, clamped_ = 0;
  std::uint64_t rays_in_ = 0, queue_peak_ = 0;
};

}  // namespace graycube

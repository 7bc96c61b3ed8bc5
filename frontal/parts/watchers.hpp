// Keeps which clients watch which job, and when they are told of its progress.
#pragma once

#include <cstdint>
#include <map>
#include <set>

#include "frontal/parts/post.hpp"

namespace graycube {

/// Watchers hear of progress at most this often, and of every round of the token.
inline constexpr double kProgressInterval_s = 0.1;

class Watchers {
 public:
  void add(std::uint32_t job, const PeerId& peer) { watchers_[job].insert(peer); }
  /// Takes the watchers of a job that has ended: nobody watches it any longer.
  std::set<PeerId> take(std::uint32_t job) {
    auto node = watchers_.extract(job);
    return node.empty() ? std::set<PeerId>{} : std::move(node.mapped());
  }

  /// Whether it is time to tell how the running job gets on.
  bool are_due(double now_s) const { return now_s - last_told_s_ >= kProgressInterval_s; }
  void tell(const control::Progress& progress, double now_s, Post& post) {
    last_told_s_ = now_s;
    const auto watchers = watchers_.find(progress.job);
    if (watchers == watchers_.end()) return;
    for (const PeerId& peer : watchers->second) post.to_peer(peer, progress);
  }

 private:
  std::map<std::uint32_t, std::set<PeerId>> watchers_;  // by job
  double last_told_s_ = 0;
};

}  // namespace graycube

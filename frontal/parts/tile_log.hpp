// Which tiles of the job that is on are whole and not recorded yet, and when they are to be.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "film/film.hpp"
#include "frontal/preparation/preparation.hpp"
#include "proto/records/tile_records.hpp"
#include "transport/message.hpp"

namespace graycube {

/// Seconds before the first records, so that short jobs take no work for it; and between others, of
/// which as much is traced again after a frontal's death.
inline constexpr double kFirstRecord_s = 0.8, kRecordInterval_s = 0.05;
/// Records are made in pieces of about so many bytes, each of which takes some milliseconds.
inline constexpr std::size_t kRecordPieceBytes = std::size_t{1} << 20;

class TileLog {
 public:
  /// Tracing begins. `head`: what stands before the first record; nothing where there are records
  /// already.
  void begin(double now_s, std::optional<RecordedPicture> head) {
    due_s_ = now_s + kFirstRecord_s;
    if (head) head_ = encode_records_head(*head);
  }
  void note(std::span<const std::uint32_t> whole) {
    waiting_.insert(waiting_.end(), whole.begin(), whole.end());
  }
  bool is_due(double now_s) const { return !waiting_.empty() && now_s >= due_s_; }
  bool is_empty() const { return waiting_.empty(); }

  /// The next piece of records; nothing is left for a while once all are taken.
  Bytes take(double now_s, const Film& film, const TilePlan& plan) {
    Bytes records = std::exchange(head_, {});
    std::size_t taken = 0;
    while (taken < waiting_.size() && records.size() < kRecordPieceBytes)
      append_tile_record(records, film, plan.rect(waiting_[taken++]));
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(taken));
    if (waiting_.empty()) due_s_ = now_s + kRecordInterval_s;
    return records;
  }

 private:
  Bytes head_;
  std::vector<std::uint32_t> waiting_;
  double due_s_ = 0;
};

}  // namespace graycube

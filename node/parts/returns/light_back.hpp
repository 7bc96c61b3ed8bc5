// Light that goes back along the rays' ways, as Cleary et al. (1983) have it: the open nodes of the
// photometric trees that have a part here (docs/design/returns.md).
//
// On the node a ray is known by its key, which lies where its pixel lies (RayTask::pixel): its
// pixel, if its tree began here; otherwise a number for the ray of its tree that came here last.
// What evaluators return is for that key, so tracing knows nothing of this. Across a link a ray
// carries a number that its sender gave it. Primary rays keep their pixel wherever they go: a tree
// begins with its first hit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "node/parts/mail.hpp"
#include "node/parts/returns/awaited_answers.hpp"
#include "node/parts/returns/slot_table.hpp"
#include "trace/step.hpp"

namespace graycube {

class LightBack {
 public:
  /// With so many open rays and pixels a node begins no tiles.
  static constexpr std::size_t kManyOpen = std::size_t{1} << 20;
  /// Answers for a link that are gathered before they are sent.
  static constexpr std::size_t kFullAnswers = 4096;
  static_assert(kFullAnswers <= kMaxAnswersPerBatch);
  static constexpr const char* kTooManyOpen =
      "too many rays wait for their light: with --returns frontal none do";

  /// `pixels` of the picture. The most rays that are owed answers, and that answers are awaited
  /// for, are `most_open` each.
  LightBack(std::uint32_t links, std::uint64_t pixels,
            std::size_t most_open = AwaitedAnswers::kMost);

  /// Rays came across a link: they get keys for their numbers. False when there are too many.
  [[nodiscard]] bool came(std::uint32_t bit, std::span<RayTask> rays);
  /// Rays leave across a link: they get numbers for their keys. False when there are too many.
  [[nodiscard]] bool leave(std::uint32_t bit, std::span<RayTask> rays);
  /// Takes what evaluators returned, and gives back what is complete and for the frontal.
  std::vector<PixelReturn> take(std::span<const PixelReturn> returns, Mail& mail);
  /// The same for answers. Nothing if the batch is broken or answers what nobody asked: the job has
  /// failed then.
  std::optional<std::vector<PixelReturn>> on_answers(std::uint32_t bit,
                                                     std::span<const std::byte> batch,
                                                     const BatchLimits& limits, Mail& mail);
  /// Sends all answers that are complete.
  void send(Mail& mail);
  /// No answer waits to be sent. Rays may be open all the same: others are at work for them.
  bool is_empty() const { return unsent_ == 0; }
  bool may_start_tiles() const { return open() < kManyOpen; }
  /// The numbers of rays and pixels that wait for light.
  std::size_t open() const { return owed_.taken() + awaited_.size() + pixels_.size(); }

  void report(control::NodeStats& stats) const;
  /// A new epoch.
  void reset();

 private:
  /// A ray that came here and is to be answered.
  struct Owed {
    FixedRgb light;
    /// What has come back of the ray's 2^-exponent: the answer is complete when all has.
    Credit credit;
    std::uint32_t number = 0;
    std::uint8_t bit = 0, exponent = 0;
  };
  /// A pixel of which rays are under way elsewhere.
  struct OpenPixel {
    FixedRgb light;
    Credit credit;
  };

  void add(const PixelReturn& light, std::vector<PixelReturn>& complete);
  void add_to_pixel(const PixelReturn& light, std::vector<PixelReturn>& complete);
  void add_to_ray(std::uint32_t slot, const PixelReturn& light);
  void answer(std::uint32_t bit, const RayAnswer& answer);
  void send_full(Mail& mail);
  void send_link(std::uint32_t bit, Mail& mail);
  void note_open();

  std::uint64_t pixel_count_;
  SlotTable<Owed> owed_;
  AwaitedAnswers awaited_;
  std::unordered_map<std::uint32_t, OpenPixel> pixels_;
  /// Complete answers, by bit; and how many they are.
  std::vector<std::vector<RayAnswer>> answers_;
  std::size_t unsent_ = 0;
  /// The batch that is taken in; a member so that its memory serves the next batch.
  std::vector<RayAnswer> received_;
  std::uint64_t open_peak_ = 0, open_bytes_peak_ = 0;
  std::uint64_t answered_ = 0, batches_ = 0, bytes_ = 0;
};

}  // namespace graycube

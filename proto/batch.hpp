// Binary batches between nodes and between nodes and the frontal. FORMAT.md, "Batches", is
// normative; this is its implementation. Encoding is for values of our own (limits are checked
// assertions), decoding for bytes that anybody may have sent (nothing throws, nothing is allocated
// before sizes are checked).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "coordination/termination.hpp"
#include "regions/macro_grid.hpp"
#include "shading/settings.hpp"
#include "trace/contribution.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// "GCB1", read as a little-endian integer.
inline constexpr std::uint32_t kBatchMagic = 0x31424347;
inline constexpr std::uint16_t kBatchVersion = 2;
inline constexpr std::size_t kBatchHeaderBytes = 44;
/// The sender "rank" of the frontal.
inline constexpr std::uint32_t kFrontalRank = 0xFFFFFFFF;

inline constexpr std::size_t kRayBytes = 102;
inline constexpr std::size_t kTileCreditBytes = 44;
/// Bytes that a pixel's light takes at most: alone in its run, and very bright.
inline constexpr std::size_t kMostPixelBytes = 30;
inline constexpr std::size_t kTokenBytes = 25;
/// Bytes of an answer without light, and of one with the brightest.
inline constexpr std::size_t kLeastAnswerBytes = 5, kMostAnswerBytes = 29;

/// Bytes of the largest message, header included: of contributions, and of every other type.
inline constexpr std::size_t kMaxContributionBatchBytes = std::size_t{8} << 20;
inline constexpr std::size_t kMaxBatchBytes = std::size_t{1} << 20;
inline constexpr std::size_t kMaxRaysPerBatch = (kMaxBatchBytes - kBatchHeaderBytes) / kRayBytes;
inline constexpr std::size_t kMaxTilesPerAssignment = (kMaxBatchBytes - kBatchHeaderBytes) / 4;
inline constexpr std::size_t kMaxClassesPerGrant = (kMaxBatchBytes - kBatchHeaderBytes) / 2;
inline constexpr std::size_t kMaxAnswersPerBatch =
    (kMaxBatchBytes - kBatchHeaderBytes) / kMostAnswerBytes;
/// Most bytes that one link-credit grant may give back.
inline constexpr std::uint64_t kMaxLinkCreditBytes = std::uint64_t{1} << 32;
/// Largest |direction · direction − 1| of a ray.
inline constexpr double kDirectionTolerance = 1e-6;

enum class BatchType : std::uint8_t {
  kRays = 1,
  kContributions = 2,
  kLinkCredit = 3,
  kToken = 4,
  kAssignment = 5,
  kGreeting = 6,
  kGreetingAck = 7,
  /// Neither is sent or answered yet: they are for nodes that are replaced while a job is on.
  kGoodbye = 8,
  kGoodbyeAck = 9,
  /// The sender has nothing to do; kIdleWithCopy: and it holds a copy of the receiver's slice.
  kIdle = 10,
  kIdleWithCopy = 11,
  /// Rays on the credit of their classes, and such credit given back (docs/design/flow.md).
  kClassRays = 12,
  kClassCredit = 13,
  /// Light that goes back along the rays' ways (docs/design/returns.md).
  kAnswers = 14,
};

/// The sender of a batch, and what the batch belongs to.
struct BatchStamp {
  std::uint32_t job = 0;
  std::uint32_t epoch = 0;
  /// The sender's rank, or kFrontalRank.
  std::uint32_t sender = 0;
  /// The sender's start number: a restarted node has another one.
  std::uint32_t incarnation = 0;
  /// 0, 1, 2 … on each directed link, from 0 again in each epoch.
  std::uint64_t sequence = 0;

  friend bool operator==(const BatchStamp&, const BatchStamp&) = default;
};

struct BatchHeader {
  BatchStamp stamp;
  BatchType type = BatchType::kRays;
  /// Number of records: rays, tile credits, assigned tiles, classes or answers; 1 for a grant or a
  /// token, 0 for greetings and goodbyes.
  std::uint32_t count = 0;
  /// Number of pixels in a batch of contributions; 0 in any other.
  std::uint32_t second_count = 0;
  std::uint32_t payload_bytes = 0;

  friend bool operator==(const BatchHeader&, const BatchHeader&) = default;
};

enum class BatchError : std::uint8_t {
  kTooShort,    // no whole header
  kBadMagic,    // not a batch
  kBadVersion,  // another version of the format
  kBadType,     // unknown, or not the type that the decoder is for
  kBadLength,   // counts, payload length and message length disagree
  kTooLarge,    // beyond the type's largest message
  kBadValue,    // a field out of its range
};
std::string_view to_string(BatchError error);
std::string_view to_string(BatchType type);

using BatchResult = std::variant<BatchHeader, BatchError>;

/// The limits below which indices and counts must stay, from the job that a batch belongs to.
struct BatchLimits {
  std::uint64_t pixel_count = 0;
  std::uint32_t tile_count = 0;
  std::uint32_t max_depth = 0;
  /// A ray of a scene without lights still has the number 0.
  std::uint32_t lights = kMaxCreditLights;
  std::uint32_t max_exponent = 255;
  /// The most links that a ray may have crossed, those of the rays before it in its tree included.
  std::uint32_t max_hops = kMaxHops;
  /// The grid of macro-regions, scattered ones included: a receiver sets its job's.
  std::uint32_t columns = kMaxGridSide, rows = kMaxGridSide;
  /// A sender's rank must be below this, unless it is the frontal.
  std::uint32_t nodes = 0;
  /// Rays other than primary ones carry a number of their sender's in place of the pixel.
  bool are_rays_numbered = false;
  /// Rays may be of either generation of the grid, as boundaries slide.
  bool may_slide = false;
};

/// What comes back for a ray that crossed a link, from whoever got it.
struct RayAnswer {
  /// The number that the ray carried.
  std::uint32_t number = 0;
  /// No more comes back for that ray: its light and credit are complete.
  bool is_last = true;
  /// Light of the ray and of all that descend from it, 0 to kMaxMergedLight in each component.
  FixedRgb light;

  friend bool operator==(const RayAnswer&, const RayAnswer&) = default;
};

/// Takes at most kMaxRaysPerBatch rays; the type is kRays or kClassRays.
std::vector<std::byte> encode_rays(const BatchStamp& stamp, std::span<const RayTask> rays,
                                   BatchType type = BatchType::kRays);
/// Takes at most kMaxClassesPerGrant classes.
std::vector<std::byte> encode_class_credit(const BatchStamp& stamp,
                                           std::span<const std::uint16_t> classes);
/// Takes at most kMaxAnswersPerBatch answers; those that aren't the last must have light.
std::vector<std::byte> encode_answers(const BatchStamp& stamp, std::span<const RayAnswer> answers);
/// The batch may have at most kMaxContributionBatchBytes, see most_contribution_bytes.
std::vector<std::byte> encode_contributions(const BatchStamp& stamp,
                                            std::span<const TileCredit> credits,
                                            std::span<const Contribution> contributions);
std::vector<std::byte> encode_link_credit(const BatchStamp& stamp, std::uint64_t bytes);
std::vector<std::byte> encode_token(const BatchStamp& stamp, const Token& token);
/// Takes at most kMaxTilesPerAssignment tiles.
std::vector<std::byte> encode_assignment(const BatchStamp& stamp,
                                         std::span<const std::uint32_t> tiles);
/// An offer to help, of type kIdle or kIdleWithCopy. `work`: what the sender has done so far in
/// this epoch, in tests of a primitive (trace/work_cost.hpp).
std::vector<std::byte> encode_offer(const BatchStamp& stamp, BatchType type, std::uint64_t work);
/// A batch of a type without payload: a greeting, a goodbye or an acknowledgement of one.
/// peek_header() checks all that there is of these.
std::vector<std::byte> encode_signal(const BatchStamp& stamp, BatchType type);

/// Bytes of a message with so many records, header included; for contributions the most bytes.
constexpr std::size_t ray_batch_bytes(std::size_t rays) {
  return kBatchHeaderBytes + rays * kRayBytes;
}
constexpr std::size_t most_contribution_bytes(std::size_t tiles, std::size_t pixels) {
  return kBatchHeaderBytes + tiles * kTileCreditBytes + pixels * kMostPixelBytes;
}

/// Checks everything about a message but its records' values: whoever gets a header may trust its
/// counts and its length, but must still compare job, epoch, sender and sequence with what it
/// expects.
[[nodiscard]] BatchResult peek_header(std::span<const std::byte> message);

/// True when a single frame is a batch rather than a control message: it starts with the magic.
bool looks_like_batch(std::span<const std::byte> message);

/// Each decodes a whole message of its type. The vectors are replaced; after an error they are
/// empty (other outputs untouched). decode_rays() is for type kRays or kClassRays, as `type`
/// says.
[[nodiscard]] BatchResult decode_rays(std::span<const std::byte> message, const BatchLimits& limits,
                                      std::vector<RayTask>& rays,
                                      BatchType type = BatchType::kRays);
[[nodiscard]] BatchResult decode_contributions(std::span<const std::byte> message,
                                               const BatchLimits& limits,
                                               std::vector<TileCredit>& credits,
                                               std::vector<Contribution>& contributions);
[[nodiscard]] BatchResult decode_link_credit(std::span<const std::byte> message,
                                             const BatchLimits& limits, std::uint64_t& bytes);
/// Takes offers of type kIdle and kIdleWithCopy.
[[nodiscard]] BatchResult decode_offer(std::span<const std::byte> message,
                                       const BatchLimits& limits, std::uint64_t& work);
[[nodiscard]] BatchResult decode_class_credit(std::span<const std::byte> message,
                                              const BatchLimits& limits,
                                              std::vector<std::uint16_t>& classes);
[[nodiscard]] BatchResult decode_answers(std::span<const std::byte> message,
                                         const BatchLimits& limits,
                                         std::vector<RayAnswer>& answers);
[[nodiscard]] BatchResult decode_token(std::span<const std::byte> message,
                                       const BatchLimits& limits, Token& token);
[[nodiscard]] BatchResult decode_assignment(std::span<const std::byte> message,
                                            const BatchLimits& limits,
                                            std::vector<std::uint32_t>& tiles);

}  // namespace graycube

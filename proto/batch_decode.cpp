#include <array>
#include <cmath>

#include "proto/batch.hpp"
#include "proto/batch_layout.hpp"
#include "proto/bytes.hpp"
#include "shading/settings.hpp"

namespace graycube {
namespace {

using namespace batch_layout;

/// A tile's credit never exceeds its number of primary rays, and so not that of any picture.
constexpr std::uint64_t kMaxTileUnits = kMaxPixels * kMaxSamples * kMaxSamples;

bool is_known(std::uint8_t type) { return type >= 1 && type <= 14; }

/// Checks the framing, the sender and the type; `payload` becomes the bytes behind the header.
BatchResult open(std::span<const std::byte> message, const BatchLimits& limits, BatchType type,
                 const std::byte*& payload) {
  const BatchResult result = peek_header(message);
  const auto* h = std::get_if<BatchHeader>(&result);
  if (h == nullptr) return result;
  if (h->type != type) return BatchError::kBadType;
  if (h->stamp.sender >= limits.nodes && h->stamp.sender != kFrontalRank)
    return BatchError::kBadValue;
  payload = message.data() + kBatchHeaderBytes;
  return result;
}

Vec3 load_vec(const std::byte* at) {
  return {load_little<double>(at), load_little<double>(at + 8), load_little<double>(at + 16)};
}

bool is_weight(double v) { return std::isfinite(v) && v >= 0; }

bool is_pixel_or_number(const RayTask& task, const BatchLimits& limits) {
  const bool is_number = limits.are_rays_numbered && task.kind != RayKind::kPrimary;
  return is_number || task.pixel < limits.pixel_count;
}

bool load_ray(const std::byte* at, const BatchLimits& limits, RayTask& task) {
  task.ray = {load_vec(at), load_vec(at + 24)};
  task.t = load_little<double>(at + 48);
  task.t_max = load_little<double>(at + 56);
  const Vec3 weight = load_vec(at + 64);
  task.weight = {weight.x, weight.y, weight.z};
  task.pixel = load_little<std::uint32_t>(at + 88);
  auto kind = load_little<std::uint8_t>(at + 92);
  task.generation = limits.may_slide && (kind & kGenerationFlag) != 0;
  if (limits.may_slide) kind &= static_cast<std::uint8_t>(~kGenerationFlag);
  task.credit_exponent = load_little<std::uint8_t>(at + 93);
  task.depth = load_little<std::uint8_t>(at + 94);
  task.light = load_little<std::uint8_t>(at + 95);
  task.region = {load_little<std::uint16_t>(at + 96), load_little<std::uint16_t>(at + 98)};
  task.hops = load_little<std::uint16_t>(at + 100);
  task.ends_at_horizon = (kind & kHorizonFlag) != 0;
  task.kind = static_cast<RayKind>(kind & ~kHorizonFlag);
  if (task.kind > RayKind::kRefraction || (task.ends_at_horizon && task.kind != RayKind::kShadow))
    return false;
  const Vec3& d = task.ray.direction;
  // Written so that NaN fails every comparison.
  return is_finite(task.ray.origin) && std::fabs(dot(d, d) - 1) <= kDirectionTolerance &&
         std::isfinite(task.t) && task.t >= 0 && task.t_max >= 0 && is_weight(weight.x) &&
         is_weight(weight.y) && is_weight(weight.z) && is_pixel_or_number(task, limits) &&
         task.credit_exponent <= limits.max_exponent && task.depth <= limits.max_depth &&
         task.light < limits.lights && task.hops <= limits.max_hops &&
         task.region.column < limits.columns && task.region.row < limits.rows;
}

bool load_credit(const std::byte* at, const BatchLimits& limits, TileCredit& credit) {
  credit.tile = load_little<std::uint32_t>(at);
  std::array<std::uint64_t, Credit::kWords> words;
  for (std::size_t w = 0; w < words.size(); ++w)
    words[w] = load_little<std::uint64_t>(at + 4 + 8 * w);
  credit.credit = Credit::from_words(words);
  // The last bit stands for 2^-256, which no ray can hold.
  return credit.tile < limits.tile_count && words[0] <= kMaxTileUnits && (words[4] & 1) == 0;
}

bool is_light(std::int64_t v) { return v >= 0 && v <= kMaxMergedLight; }

/// Reads a run's light into `pixels`, the first of which is pixel number `first`. False unless the
/// components take no more bytes than they need, and none is too large.
template <std::size_t kBytes>
bool load_run(const std::byte* at, std::uint32_t first, std::span<Contribution> pixels) {
  std::uint64_t bits = 0;
  bool is_bounded = true;
  for (Contribution& c : pixels) {
    c.pixel = first++;
    for (std::int64_t* component : {&c.light.r, &c.light.g, &c.light.b}) {
      const std::uint64_t value = load_low_bytes<kBytes>(at);
      *component = static_cast<std::int64_t>(value);
      bits |= value;
      // Components of fewer than 8 bytes are always small enough.
      if constexpr (kBytes == 8) is_bounded = is_bounded && is_light(*component);
      at += kBytes;
    }
  }
  return is_bounded && component_bytes(bits) == kBytes;
}

/// Reads all runs of `bytes`, which must fill `all` exactly. Runs must be as long as they can be.
bool load_light(std::span<const std::byte> bytes, const BatchLimits& limits,
                std::span<Contribution> all) {
  ByteReader r(bytes);
  std::uint64_t end = 0;
  bool may_continue = false;
  while (!all.empty()) {
    const auto first = r.get<std::uint32_t>();
    const std::size_t count = r.get<std::uint8_t>(), width = r.get<std::uint8_t>();
    if (count == 0 || count > all.size() || width == 0 || width > sizeof(std::uint64_t))
      return false;
    if (first + std::uint64_t{count} > limits.pixel_count || (may_continue && first == end))
      return false;
    const std::byte* at = r.take(3 * width * count);
    if (at == nullptr) return false;
    bool is_sound = false;
    with_component_bytes(
        width, [&](auto kBytes) { is_sound = load_run<kBytes>(at, first, all.first(count)); });
    if (!is_sound) return false;
    end = first + std::uint64_t{count};
    may_continue = count < kMaxRunPixels;
    all = all.subspan(count);
  }
  return r.remaining() == 0;
}

/// Fills `records` with `count` records of `size` bytes; empties it when one of them is wrong.
template <class Record, class Load>
bool load_all(const std::byte* at, std::size_t count, std::size_t size, const BatchLimits& limits,
              Load&& load, std::vector<Record>& records) {
  records.clear();
  records.reserve(count);
  while (records.size() < count) {
    if (!load(at, limits, records.emplace_back())) [[unlikely]] {
      records.clear();
      return false;
    }
    at += size;
  }
  return true;
}

/// Reads an answer, of whatever length. False unless it is there, its components take no more bytes
/// than they need, and it either brings light or is the last.
bool load_answer(ByteReader& r, RayAnswer& answer) {
  answer.number = r.get<std::uint32_t>();
  const auto width_and_more = r.get<std::uint8_t>();
  answer.is_last = (width_and_more & kMoreFlag) == 0;
  const std::size_t width = width_and_more & ~std::size_t{kMoreFlag};
  if (width == 0) return r.ok() && answer.is_last;
  if (width > sizeof(std::uint64_t)) return false;
  const std::byte* at = r.take(3 * width);
  if (at == nullptr) return false;
  Contribution c;
  bool is_sound = false;
  with_component_bytes(width,
                       [&](auto kBytes) { is_sound = load_run<kBytes>(at, 0, std::span(&c, 1)); });
  answer.light = c.light;
  return is_sound && bits_of(answer.light) != 0;
}

bool load_class(const std::byte* at, const BatchLimits& limits, std::uint16_t& hops) {
  hops = load_little<std::uint16_t>(at);
  return hops <= limits.max_hops;
}

bool load_tile(const std::byte* at, const BatchLimits& limits, std::uint32_t& tile) {
  tile = load_little<std::uint32_t>(at);
  return tile < limits.tile_count;
}

}  // namespace

bool looks_like_batch(std::span<const std::byte> message) {
  return message.size() >= 4 && load_little<std::uint32_t>(message.data()) == kBatchMagic;
}

BatchResult peek_header(std::span<const std::byte> message) {
  if (message.size() < kBatchHeaderBytes) return BatchError::kTooShort;
  ByteReader r(message);
  if (r.get<std::uint32_t>() != kBatchMagic) return BatchError::kBadMagic;
  if (r.get<std::uint16_t>() != kBatchVersion) return BatchError::kBadVersion;
  const auto type = r.get<std::uint8_t>();
  if (!is_known(type)) return BatchError::kBadType;
  if (r.get<std::uint8_t>() != 0) return BatchError::kBadValue;
  BatchHeader h;
  h.type = static_cast<BatchType>(type);
  h.stamp.job = r.get<std::uint32_t>();
  h.stamp.epoch = r.get<std::uint32_t>();
  h.stamp.sender = r.get<std::uint32_t>();
  h.stamp.sequence = r.get<std::uint64_t>();
  h.count = r.get<std::uint32_t>();
  h.second_count = r.get<std::uint32_t>();
  h.payload_bytes = r.get<std::uint32_t>();
  h.stamp.incarnation = r.get<std::uint32_t>();
  if (message.size() > max_message_bytes(h.type)) return BatchError::kTooLarge;
  const PayloadRule rule = payload_rule(h);
  if (!rule.counts_fit || h.payload_bytes < rule.bytes ||
      h.payload_bytes - rule.bytes > rule.more || h.payload_bytes != r.remaining()) {
    return BatchError::kBadLength;
  }
  return h;
}

BatchResult decode_rays(std::span<const std::byte> message, const BatchLimits& limits,
                        std::vector<RayTask>& rays, BatchType type) {
  const std::byte* at = nullptr;
  const BatchResult result = open(message, limits, type, at);
  const auto* h = std::get_if<BatchHeader>(&result);
  if (h == nullptr) {
    rays.clear();
    return result;
  }
  if (!load_all(at, h->count, kRayBytes, limits, load_ray, rays)) return BatchError::kBadValue;
  return result;
}

BatchResult decode_contributions(std::span<const std::byte> message, const BatchLimits& limits,
                                 std::vector<TileCredit>& credits,
                                 std::vector<Contribution>& contributions) {
  credits.clear();
  const std::byte* at = nullptr;
  const BatchResult result = open(message, limits, BatchType::kContributions, at);
  const auto* h = std::get_if<BatchHeader>(&result);
  if (h == nullptr) {
    contributions.clear();
    return result;
  }
  const std::size_t credit_bytes = h->count * kTileCreditBytes;
  // Contributions of the last batch remain: all are overwritten, so that none need be made anew.
  contributions.resize(h->second_count);
  if (!load_all(at, h->count, kTileCreditBytes, limits, load_credit, credits) ||
      !load_light({at + credit_bytes, h->payload_bytes - credit_bytes}, limits, contributions)) {
    credits.clear();
    contributions.clear();
    return BatchError::kBadValue;
  }
  return result;
}

BatchResult decode_link_credit(std::span<const std::byte> message, const BatchLimits& limits,
                               std::uint64_t& bytes) {
  const std::byte* at = nullptr;
  const BatchResult result = open(message, limits, BatchType::kLinkCredit, at);
  if (!std::holds_alternative<BatchHeader>(result)) return result;
  const auto granted = load_little<std::uint64_t>(at);
  if (granted > kMaxLinkCreditBytes) return BatchError::kBadValue;
  bytes = granted;
  return result;
}

BatchResult decode_class_credit(std::span<const std::byte> message, const BatchLimits& limits,
                                std::vector<std::uint16_t>& classes) {
  classes.clear();
  const std::byte* at = nullptr;
  const BatchResult result = open(message, limits, BatchType::kClassCredit, at);
  const auto* h = std::get_if<BatchHeader>(&result);
  if (h == nullptr) return result;
  if (!load_all(at, h->count, 2, limits, load_class, classes)) return BatchError::kBadValue;
  return result;
}

BatchResult decode_answers(std::span<const std::byte> message, const BatchLimits& limits,
                           std::vector<RayAnswer>& answers) {
  answers.clear();
  const std::byte* at = nullptr;
  const BatchResult result = open(message, limits, BatchType::kAnswers, at);
  const auto* h = std::get_if<BatchHeader>(&result);
  if (h == nullptr) return result;
  ByteReader r({at, h->payload_bytes});
  answers.reserve(h->count);
  while (answers.size() < h->count) {
    if (load_answer(r, answers.emplace_back())) continue;
    answers.clear();
    return BatchError::kBadValue;
  }
  if (r.remaining() == 0) return result;
  answers.clear();
  return BatchError::kBadValue;
}

BatchResult decode_token(std::span<const std::byte> message, const BatchLimits& limits,
                         Token& token) {
  const std::byte* at = nullptr;
  const BatchResult result = open(message, limits, BatchType::kToken, at);
  if (!std::holds_alternative<BatchHeader>(result)) return result;
  const auto colour = load_little<std::uint8_t>(at);
  if (colour > 1) return BatchError::kBadValue;
  token = {colour == 1, load_little<std::int64_t>(at + 1), load_little<std::uint32_t>(at + 9),
           load_little<std::uint32_t>(at + 13), load_little<std::uint64_t>(at + 17)};
  return result;
}

BatchResult decode_assignment(std::span<const std::byte> message, const BatchLimits& limits,
                              std::vector<std::uint32_t>& tiles) {
  tiles.clear();
  const std::byte* at = nullptr;
  const BatchResult result = open(message, limits, BatchType::kAssignment, at);
  const auto* h = std::get_if<BatchHeader>(&result);
  if (h == nullptr) return result;
  if (!load_all(at, h->count, 4, limits, load_tile, tiles)) return BatchError::kBadValue;
  return result;
}

BatchResult decode_offer(std::span<const std::byte> message, const BatchLimits& limits,
                         std::uint64_t& work) {
  const BatchResult peeked = peek_header(message);
  const auto* h = std::get_if<BatchHeader>(&peeked);
  if (h == nullptr) return peeked;
  if (!is_offer(h->type)) return BatchError::kBadType;
  const std::byte* at = nullptr;
  const BatchResult result = open(message, limits, h->type, at);
  if (std::holds_alternative<BatchHeader>(result)) work = load_little<std::uint64_t>(at);
  return result;
}

}  // namespace graycube

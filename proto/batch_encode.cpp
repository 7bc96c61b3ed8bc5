#include <algorithm>
#include <utility>

#include "check.hpp"
#include "proto/batch.hpp"
#include "proto/batch_layout.hpp"
#include "proto/bytes.hpp"

namespace graycube {
namespace {

using namespace batch_layout;

/// A writer that already holds the header. `count` and `second` decide the payload's size, except
/// for `more` bytes.
ByteWriter begin(const BatchStamp& stamp, BatchType type, std::size_t count, std::size_t second,
                 std::size_t more = 0) {
  BatchHeader h{stamp, type, static_cast<std::uint32_t>(count), static_cast<std::uint32_t>(second),
                0};
  const PayloadRule rule = payload_rule(h);
  const std::uint64_t size = kBatchHeaderBytes + rule.bytes + more;
  GRAYCUBE_CHECK(rule.counts_fit && more <= rule.more && count == h.count &&
                     second == h.second_count && size <= max_message_bytes(type),
                 "%zu + %zu records in one %s batch", count, second, to_string(type).data());
  ByteWriter w(static_cast<std::size_t>(size));
  w.put(kBatchMagic);
  w.put(kBatchVersion);
  w.put(static_cast<std::uint8_t>(type));
  w.put(std::uint8_t{0});
  w.put(stamp.job);
  w.put(stamp.epoch);
  w.put(stamp.sender);
  w.put(stamp.sequence);
  w.put(h.count);
  w.put(h.second_count);
  w.put(static_cast<std::uint32_t>(rule.bytes + more));
  w.put(stamp.incarnation);
  return w;
}

void store_vec(std::byte* at, double x, double y, double z) {
  store_little(at, x);
  store_little(at + 8, y);
  store_little(at + 16, z);
}

void store_ray(std::byte* at, const RayTask& task) {
  const auto& [origin, direction] = task.ray;
  store_vec(at, origin.x, origin.y, origin.z);
  store_vec(at + 24, direction.x, direction.y, direction.z);
  store_little(at + 48, task.t);
  store_little(at + 56, task.t_max);
  store_vec(at + 64, task.weight.r, task.weight.g, task.weight.b);
  store_little(at + 88, task.pixel);
  store_little(at + 92, static_cast<std::uint8_t>(static_cast<std::uint8_t>(task.kind) |
                                                  (task.ends_at_horizon ? kHorizonFlag : 0) |
                                                  (task.generation != 0 ? kGenerationFlag : 0)));
  store_little(at + 93, task.credit_exponent);
  store_little(at + 94, static_cast<std::uint8_t>(task.depth));
  store_little(at + 95, static_cast<std::uint8_t>(task.light));
  store_little(at + 96, task.region.column);
  store_little(at + 98, task.region.row);
  store_little(at + 100, task.hops);
}

/// Light of pixels side by side, each component in `component_bytes` bytes.
struct LightRun {
  std::span<const Contribution> pixels;
  std::size_t component_bytes = 1;

  std::size_t bytes() const { return kRunHeaderBytes + 3 * component_bytes * pixels.size(); }
};

/// Bytes of each component of an answer's light: none where there is no light.
std::size_t answer_component_bytes(const FixedRgb& light) {
  return bits_of(light) == 0 ? 0 : component_bytes(bits_of(light));
}

template <std::size_t kBytes>
std::byte* store_light(std::byte* at, const FixedRgb& light) {
  for (const std::int64_t component : {light.r, light.g, light.b}) {
    store_low_bytes<kBytes>(at, static_cast<std::uint64_t>(component));
    at += kBytes;
  }
  return at;
}

/// Splits light into the longest runs possible, in order.
std::vector<LightRun> runs_of(std::span<const Contribution> all) {
  std::vector<LightRun> runs;
  while (!all.empty()) {
    const std::size_t most = std::min(all.size(), kMaxRunPixels);
    std::uint64_t bits = bits_of(all[0].light);
    std::size_t count = 1;
    for (; count < most && all[count].pixel == all[count - 1].pixel + 1; ++count)
      bits |= bits_of(all[count].light);
    runs.push_back({all.first(count), component_bytes(bits)});
    all = all.subspan(count);
  }
  return runs;
}

void store_run(std::byte* at, const LightRun& run) {
  store_little(at, run.pixels.front().pixel);
  store_little(at + 4, static_cast<std::uint8_t>(run.pixels.size()));
  store_little(at + 5, static_cast<std::uint8_t>(run.component_bytes));
  at += kRunHeaderBytes;
  with_component_bytes(run.component_bytes, [&](auto bytes) {
    for (const Contribution& c : run.pixels) at = store_light<bytes>(at, c.light);
  });
}

}  // namespace

std::vector<std::byte> encode_rays(const BatchStamp& stamp, std::span<const RayTask> rays,
                                   BatchType type) {
  GRAYCUBE_CHECK(type == BatchType::kRays || type == BatchType::kClassRays, "rays in a %s batch",
                 to_string(type).data());
  ByteWriter w = begin(stamp, type, rays.size(), 0);
  std::byte* at = w.room(rays.size() * kRayBytes);
  for (const RayTask& task : rays) {
    store_ray(at, task);
    at += kRayBytes;
  }
  return std::move(w).take();
}

std::vector<std::byte> encode_contributions(const BatchStamp& stamp,
                                            std::span<const TileCredit> credits,
                                            std::span<const Contribution> contributions) {
  const std::vector<LightRun> runs = runs_of(contributions);
  std::size_t light_bytes = 0;
  for (const LightRun& run : runs) light_bytes += run.bytes();
  ByteWriter w = begin(stamp, BatchType::kContributions, credits.size(), contributions.size(),
                       light_bytes - contributions.size() * kLeastPixelBytes);
  for (const TileCredit& c : credits) {
    w.put(c.tile);
    for (const std::uint64_t word : c.credit.words()) w.put(word);
  }
  for (const LightRun& run : runs) store_run(w.room(run.bytes()), run);
  return std::move(w).take();
}

std::vector<std::byte> encode_link_credit(const BatchStamp& stamp, std::uint64_t bytes) {
  ByteWriter w = begin(stamp, BatchType::kLinkCredit, 1, 0);
  w.put(bytes);
  return std::move(w).take();
}

std::vector<std::byte> encode_offer(const BatchStamp& stamp, BatchType type, std::uint64_t work) {
  GRAYCUBE_CHECK(is_offer(type), "type %d", static_cast<int>(type));
  ByteWriter w = begin(stamp, type, 1, 0);
  w.put(work);
  return std::move(w).take();
}

std::vector<std::byte> encode_class_credit(const BatchStamp& stamp,
                                           std::span<const std::uint16_t> classes) {
  ByteWriter w = begin(stamp, BatchType::kClassCredit, classes.size(), 0);
  for (const std::uint16_t c : classes) w.put(c);
  return std::move(w).take();
}

std::vector<std::byte> encode_answers(const BatchStamp& stamp, std::span<const RayAnswer> answers) {
  std::size_t light_bytes = 0;
  for (const RayAnswer& a : answers) light_bytes += 3 * answer_component_bytes(a.light);
  ByteWriter w = begin(stamp, BatchType::kAnswers, answers.size(), 0, light_bytes);
  for (const RayAnswer& a : answers) {
    const std::size_t width = answer_component_bytes(a.light);
    w.put(a.number);
    w.put(static_cast<std::uint8_t>(width | (a.is_last ? 0 : kMoreFlag)));
    std::byte* at = w.room(3 * width);
    if (width == 0) continue;
    with_component_bytes(width, [&](auto bytes) { store_light<bytes>(at, a.light); });
  }
  return std::move(w).take();
}

std::vector<std::byte> encode_token(const BatchStamp& stamp, const Token& token) {
  ByteWriter w = begin(stamp, BatchType::kToken, 1, 0);
  w.put(static_cast<std::uint8_t>(token.black ? 1 : 0));
  w.put(token.count);
  w.put(token.round);
  w.put(token.hops);
  w.put(token.contribution_batches);
  return std::move(w).take();
}

std::vector<std::byte> encode_assignment(const BatchStamp& stamp,
                                         std::span<const std::uint32_t> tiles) {
  ByteWriter w = begin(stamp, BatchType::kAssignment, tiles.size(), 0);
  for (const std::uint32_t tile : tiles) w.put(tile);
  return std::move(w).take();
}

std::vector<std::byte> encode_signal(const BatchStamp& stamp, BatchType type) {
  GRAYCUBE_CHECK(is_signal(type), "%s has a payload", to_string(type).data());
  return begin(stamp, type, 0, 0).take();
}

std::string_view to_string(BatchError error) {
  switch (error) {
    case BatchError::kTooShort: return "too short";
    case BatchError::kBadMagic: return "bad magic";
    case BatchError::kBadVersion: return "bad version";
    case BatchError::kBadType: return "bad type";
    case BatchError::kBadLength: return "bad length";
    case BatchError::kTooLarge: return "too large";
    case BatchError::kBadValue: return "bad value";
  }
  return "unknown";
}

std::string_view to_string(BatchType type) {
  switch (type) {
    case BatchType::kRays: return "rays";
    case BatchType::kContributions: return "contributions";
    case BatchType::kLinkCredit: return "link_credit";
    case BatchType::kToken: return "token";
    case BatchType::kAssignment: return "assignment";
    case BatchType::kGreeting: return "greeting";
    case BatchType::kGreetingAck: return "greeting_ack";
    case BatchType::kGoodbye: return "goodbye";
    case BatchType::kGoodbyeAck: return "goodbye_ack";
    case BatchType::kIdle: return "idle";
    case BatchType::kIdleWithCopy: return "idle_with_copy";
    case BatchType::kClassRays: return "class_rays";
    case BatchType::kClassCredit: return "class_credit";
    case BatchType::kAnswers: return "answers";
  }
  return "unknown";
}

}  // namespace graycube

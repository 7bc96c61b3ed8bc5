#include "node/parts/returns/light_back.hpp"

#include <algorithm>
#include <string>

namespace graycube {
namespace {

/// A key with this bit is not a pixel but the slot of a ray that came here. Slots of AOVs, which
/// are the largest numbers for pixels, have it not.
constexpr std::uint32_t kRayKey = std::uint32_t{1} << 31;
static_assert(kMaxPixels * (1 + kAovPlanes) <= kRayKey && AwaitedAnswers::kMost <= kRayKey);

/// Whether rays that hold some of this sum's last unit are still under way.
bool has_fraction(const Credit& credit) {
  const auto& words = credit.words();
  return std::any_of(words.begin() + 1, words.end(), [](std::uint64_t w) { return w != 0; });
}

Credit power(std::uint8_t exponent) {
  Credit credit;
  credit.add_power(exponent);
  return credit;
}

PixelReturn return_of(std::uint32_t key, const FixedRgb& light, const Credit& credit) {
  return {key, light == FixedRgb{} ? 0u : 1u, light, credit};
}

}  // namespace

LightBack::LightBack(std::uint32_t links, std::uint64_t pixels, std::size_t most_open)
    : pixel_count_(pixels), owed_(most_open), awaited_(most_open), answers_(links) {}

void LightBack::reset() {
  owed_.clear();
  awaited_.clear();
  pixels_.clear();
  for (std::vector<RayAnswer>& answers : answers_) answers.clear();
  unsent_ = 0;
}

// ---- rays

bool LightBack::came(std::uint32_t bit, std::span<RayTask> rays) {
  for (RayTask& ray : rays) {
    if (ray.kind == RayKind::kPrimary) continue;
    const auto slot = owed_.take();
    if (!slot) return false;
    owed_[*slot] = {{}, {}, ray.pixel, static_cast<std::uint8_t>(bit), ray.credit_exponent};
    ray.pixel = kRayKey | *slot;
  }
  note_open();
  return true;
}

bool LightBack::leave(std::uint32_t bit, std::span<RayTask> rays) {
  for (RayTask& ray : rays) {
    if (ray.kind == RayKind::kPrimary) continue;
    const auto number = awaited_.expect(ray.pixel, bit, ray.credit_exponent);
    if (!number) return false;
    ray.pixel = *number;
  }
  note_open();
  return true;
}

// ---- light

std::vector<PixelReturn> LightBack::take(std::span<const PixelReturn> returns, Mail& mail) {
  std::vector<PixelReturn> complete;
  complete.reserve(returns.size());
  for (const PixelReturn& r : returns) add(r, complete);
  note_open();
  send_full(mail);
  return complete;
}

std::optional<std::vector<PixelReturn>> LightBack::on_answers(std::uint32_t bit,
                                                              std::span<const std::byte> batch,
                                                              const BatchLimits& limits,
                                                              Mail& mail) {
  const auto result = decode_answers(batch, limits, received_);
  const auto* error = std::get_if<BatchError>(&result);
  std::vector<PixelReturn> complete;
  bool is_sound = error == nullptr;
  for (const RayAnswer& a : received_) {
    const AwaitedAnswers::Awaited* ray = awaited_.find(a.number, bit);
    is_sound = ray != nullptr;
    if (!is_sound) break;
    add(return_of(ray->key, a.light, a.is_last ? power(ray->exponent) : Credit{}), complete);
    if (a.is_last) awaited_.came(a.number);
  }
  if (!is_sound) {
    mail.drop("answers", error != nullptr ? to_string(*error) : "to a ray that didn't go there");
    mail.fail("a broken batch of answers came from node " + std::to_string(mail.peer(bit).value));
    return std::nullopt;
  }
  note_open();
  send_full(mail);
  return complete;
}

/// Adds light and credit to the ray that came here, or to the pixel, that they are for. What is for
/// the frontal and complete goes to the end of `complete`.
void LightBack::add(const PixelReturn& light, std::vector<PixelReturn>& complete) {
  if ((light.pixel & kRayKey) != 0) return add_to_ray(light.pixel & ~kRayKey, light);
  // AOVs bring no credit.
  if (light.pixel >= pixel_count_ || !has_fraction(light.credit)) return complete.push_back(light);
  add_to_pixel(light, complete);
}

/// A pixel is complete when all credit that came back makes whole primary rays. When several
/// samples are open that may be so by chance; then the pixel's light goes to the frontal in more
/// parts than it need do.
void LightBack::add_to_pixel(const PixelReturn& light, std::vector<PixelReturn>& complete) {
  const auto [at, is_new] = pixels_.try_emplace(light.pixel);
  OpenPixel& sum = at->second;
  if (is_too_much(sum.light, light.light)) {
    complete.push_back(return_of(light.pixel, sum.light, {}));
    sum.light = {};
  }
  sum.light.add(light.light);
  sum.credit.add(light.credit);
  if (has_fraction(sum.credit)) return;
  complete.push_back(return_of(light.pixel, sum.light, sum.credit));
  pixels_.erase(at);
}

void LightBack::add_to_ray(std::uint32_t slot, const PixelReturn& light) {
  Owed& ray = owed_[slot];
  if (is_too_much(ray.light, light.light)) {
    answer(ray.bit, {ray.number, false, ray.light});
    ray.light = {};
  }
  ray.light.add(light.light);
  ray.credit.add(light.credit);
  if (ray.credit != power(ray.exponent)) return;
  answer(ray.bit, {ray.number, true, ray.light});
  owed_.give_up(slot);
  ++answered_;
}

// ---- sending

void LightBack::answer(std::uint32_t bit, const RayAnswer& answer) {
  answers_[bit].push_back(answer);
  ++unsent_;
}

void LightBack::send(Mail& mail) {
  for (std::uint32_t bit = 0; bit < answers_.size(); ++bit) send_link(bit, mail);
}

void LightBack::send_full(Mail& mail) {
  for (std::uint32_t bit = 0; bit < answers_.size(); ++bit) {
    if (answers_[bit].size() >= kFullAnswers) send_link(bit, mail);
  }
}

void LightBack::send_link(std::uint32_t bit, Mail& mail) {
  for (std::span<const RayAnswer> rest = answers_[bit]; !rest.empty();) {
    const auto first = rest.first(std::min(rest.size(), kFullAnswers));
    bytes_ += mail.work_to_neighbour(
        bit, [&](const BatchStamp& stamp) { return encode_answers(stamp, first); });
    ++batches_;
    rest = rest.subspan(first.size());
  }
  unsent_ -= answers_[bit].size();
  answers_[bit].clear();
}

// ---- counts

void LightBack::note_open() {
  // A node of the map holds a link to the next one beside its key and value.
  constexpr std::size_t kPixelBytes = sizeof(decltype(pixels_)::value_type) + sizeof(void*);
  open_peak_ = std::max<std::uint64_t>(open_peak_, open());
  open_bytes_peak_ = std::max<std::uint64_t>(open_bytes_peak_,
                                             owed_.taken() * sizeof(Owed) +
                                                 awaited_.size() * sizeof(AwaitedAnswers::Awaited) +
                                                 pixels_.size() * kPixelBytes);
}

void LightBack::report(control::NodeStats& stats) const {
  stats.open_peak = open_peak_;
  stats.open_bytes_peak = open_bytes_peak_;
  stats.answers = answered_;
  stats.answer_batches = batches_;
  stats.answer_bytes = bytes_;
}

}  // namespace graycube

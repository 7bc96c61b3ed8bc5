#include "proto/horizon_bytes.hpp"

#include "proto/bytes.hpp"

namespace graycube {

std::vector<std::byte> encode_horizons(const LightHorizons& horizons) {
  const auto& maps = horizons.maps();
  GRAYCUBE_CHECK(maps.size() <= kMaxCreditLights, "%zu lights", maps.size());
  std::size_t size = kHorizonHeaderBytes + maps.size();
  for (const auto& map : maps) size += map.size() * sizeof(float);
  ByteWriter w(size);
  w.put(kHorizonMagic);
  w.put(LightHorizons::kSide);
  w.put(static_cast<std::uint32_t>(maps.size()));
  for (const auto& map : maps) {
    w.put(static_cast<std::uint8_t>(map.empty() ? 0 : 1));
    for (const float distance : map) w.put(distance);
  }
  return std::move(w).take();
}

std::optional<LightHorizons> decode_horizons(std::span<const std::byte> bytes, std::size_t lights) {
  if (bytes.size() > kMaxHorizonBytes) return std::nullopt;
  ByteReader r(bytes);
  if (r.get<std::uint32_t>() != kHorizonMagic) return std::nullopt;
  if (r.get<std::uint32_t>() != LightHorizons::kSide) return std::nullopt;
  if (r.get<std::uint32_t>() != lights) return std::nullopt;
  std::vector<LightHorizons::Map> maps;
  for (std::size_t light = 0; light < lights && r.ok(); ++light) {
    auto& map = maps.emplace_back();
    const auto has_map = r.get<std::uint8_t>();
    if (has_map > 1) return std::nullopt;
    if (has_map == 0) continue;
    const std::byte* at = r.take(LightHorizons::kTexels * sizeof(float));
    if (at == nullptr) return std::nullopt;
    map.reserve(LightHorizons::kTexels);
    for (std::size_t i = 0; i < LightHorizons::kTexels; ++i) {
      map.push_back(load_little<float>(at + i * sizeof(float)));
      // Written so that NaN fails too.
      if (!(map.back() >= 0)) return std::nullopt;
    }
  }
  if (!r.ok() || r.remaining() != 0) return std::nullopt;
  return LightHorizons(std::move(maps));
}

}  // namespace graycube

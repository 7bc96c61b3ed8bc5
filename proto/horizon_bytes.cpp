#include "proto/horizon_bytes.hpp"

#include <cmath>

#include "proto/bytes.hpp"

namespace graycube {
namespace {

std::size_t depth_bytes(const LightDepths& depths) {
  if (depths.split == 0) return 1;
  return 1 + kDepthHeaderBytes + depths.blocks.size() * sizeof(std::uint32_t) +
         (depths.lit.size() + depths.dark.size()) * sizeof(std::uint16_t);
}

void put_depths(const LightDepths& depths, ByteWriter& w) {
  w.put(static_cast<std::uint8_t>(depths.split));
  if (depths.split == 0) return;
  w.put(depths.unit);
  w.put(depths.clearance);
  w.put(static_cast<std::uint32_t>(depths.blocks.size()));
  for (const std::uint32_t block : depths.blocks) w.put(block);
  for (const std::uint16_t distance : depths.lit) w.put(distance);
  for (const std::uint16_t distance : depths.dark) w.put(distance);
}

bool is_positive(double x) { return x > 0 && std::isfinite(x); }

/// Calls f for each run of texels beyond which there is nothing, and the distances that follow it.
template <typename F>
void for_each_run(const HorizonMap& map, F&& f) {
  const std::span<const std::uint16_t> units = map.units;
  for (std::size_t at = 0; at < units.size();) {
    const std::size_t begin = at;
    while (at < units.size() && units[at] == HorizonMap::kNever) ++at;
    const std::size_t first = at;
    while (at < units.size() && units[at] != HorizonMap::kNever) ++at;
    f(static_cast<std::uint16_t>(first - begin), units.subspan(first, at - first));
  }
}

std::size_t map_bytes(const HorizonMap& map) {
  std::size_t bytes = sizeof map.unit;
  for_each_run(map, [&](std::uint16_t, std::span<const std::uint16_t> units) {
    bytes += (2 + units.size()) * sizeof(std::uint16_t);
  });
  return bytes;
}

void put_map(const HorizonMap& map, ByteWriter& w) {
  w.put(map.unit);
  for_each_run(map, [&](std::uint16_t never, std::span<const std::uint16_t> units) {
    w.put(never);
    w.put(static_cast<std::uint16_t>(units.size()));
    for (const std::uint16_t u : units) w.put(u);
  });
}

/// Reads a map; false when the bytes are no map.
bool take_map(ByteReader& r, HorizonMap& map) {
  map.unit = r.get<double>();
  if (!is_positive(map.unit)) return false;
  map.units.reserve(LightHorizons::kTexels);
  while (map.units.size() < LightHorizons::kTexels) {
    const std::size_t never = r.get<std::uint16_t>(), count = r.get<std::uint16_t>();
    if (!r.ok() || never + count == 0 || never + count > LightHorizons::kTexels - map.units.size())
      return false;
    map.units.resize(map.units.size() + never, HorizonMap::kNever);
    const std::byte* at = r.take(count * sizeof(std::uint16_t));
    if (at == nullptr) return false;
    for (std::size_t i = 0; i < count; ++i)
      map.units.push_back(load_little<std::uint16_t>(at + i * sizeof(std::uint16_t)));
  }
  return true;
}

/// Reads `count` distances; false when fewer bytes are left.
bool take_distances(ByteReader& r, std::uint64_t count, std::vector<std::uint16_t>& distances) {
  const std::byte* at = r.take(count * sizeof(std::uint16_t));
  if (at == nullptr) return false;
  distances.resize(count);
  for (std::uint64_t i = 0; i < count; ++i)
    distances[i] = load_little<std::uint16_t>(at + i * sizeof(std::uint16_t));
  return true;
}

/// Reads a light's depths; false when they are none, or have more than `most_texels` texels.
bool take_depths(ByteReader& r, std::uint64_t most_texels, LightDepths& depths) {
  depths.split = r.get<std::uint8_t>();
  if (depths.split == 0) return true;
  depths.unit = r.get<double>();
  depths.clearance = r.get<double>();
  const std::uint64_t blocks = r.get<std::uint32_t>();
  if (depths.split > LightDepths::kMostSplit || !is_positive(depths.unit) ||
      !is_positive(depths.clearance))
    return false;
  const std::uint64_t texels = blocks * depths.dark_split() * depths.dark_split();
  if (blocks == 0 || blocks > LightHorizons::kTexels || texels > most_texels) return false;
  for (std::uint64_t i = 0; i < blocks; ++i) {
    const auto block = r.get<std::uint32_t>();
    if (block >= LightHorizons::kTexels || (i > 0 && block <= depths.blocks.back())) return false;
    depths.blocks.push_back(block);
  }
  return take_distances(r, blocks * depths.split * depths.split, depths.lit) &&
         take_distances(r, texels, depths.dark);
}

}  // namespace

std::vector<std::byte> encode_horizons(const LightHorizons& horizons) {
  const auto& maps = horizons.maps();
  GRAYCUBE_CHECK(maps.size() <= kMaxCreditLights, "%zu lights", maps.size());
  const LightDepths none;
  const auto depths = [&](std::size_t light) -> const LightDepths& {
    return light < horizons.depths().size() ? horizons.depths()[light] : none;
  };
  std::size_t size = kHorizonHeaderBytes;
  for (std::size_t light = 0; light < maps.size(); ++light) {
    size += 1 + (maps[light].empty() ? 0 : map_bytes(maps[light]) + depth_bytes(depths(light)));
  }
  ByteWriter w(size);
  w.put(kHorizonMagic);
  w.put(LightHorizons::kSide);
  w.put(static_cast<std::uint32_t>(maps.size()));
  for (std::size_t light = 0; light < maps.size(); ++light) {
    w.put(static_cast<std::uint8_t>(maps[light].empty() ? 0 : 1));
    if (maps[light].empty()) continue;
    put_map(maps[light], w);
    put_depths(depths(light), w);
  }
  return std::move(w).take();
}

std::optional<LightHorizons> decode_horizons(std::span<const std::byte> bytes, std::size_t lights) {
  if (bytes.size() > kMaxHorizonBytes) return std::nullopt;
  ByteReader r(bytes);
  if (r.get<std::uint32_t>() != kHorizonMagic) return std::nullopt;
  if (r.get<std::uint32_t>() != LightHorizons::kSide) return std::nullopt;
  if (r.get<std::uint32_t>() != lights) return std::nullopt;
  std::vector<HorizonMap> maps;
  std::vector<LightDepths> depths;
  std::uint64_t most_texels = kMostDepthTexels;
  for (std::size_t light = 0; light < lights && r.ok(); ++light) {
    auto& map = maps.emplace_back();
    auto& of_light = depths.emplace_back();
    const auto has_map = r.get<std::uint8_t>();
    if (has_map > 1) return std::nullopt;
    if (has_map == 0) continue;
    if (!take_map(r, map) || !take_depths(r, most_texels, of_light)) return std::nullopt;
    most_texels -= of_light.dark.size();
  }
  if (!r.ok() || r.remaining() != 0) return std::nullopt;
  return LightHorizons(std::move(maps), std::move(depths));
}

}  // namespace graycube

#include "formats/brlcad/database/database.hpp"

#include <algorithm>
#include <cmath>

#include "formats/brlcad/database/words.hpp"

namespace graycube {

void BrlcadDatabase::add(BrlcadObject object) {
  if (BrlcadObject* same = find(object.name)) {
    *same = std::move(object);
    return;
  }
  by_name.emplace(object.name, objects.size());
  objects.push_back(std::move(object));
}

std::size_t brlcad_value_count(BrlcadKind kind) {
  switch (kind) {
    case BrlcadKind::kArb8: return 24;
    case BrlcadKind::kTgc: return 18;
    case BrlcadKind::kEll: return 12;
    case BrlcadKind::kTor: return 8;
    case BrlcadKind::kHalf: return 4;
    case BrlcadKind::kRpc: return 10;
    case BrlcadKind::kRhc:
    case BrlcadKind::kEpa:
    case BrlcadKind::kHyp:
    case BrlcadKind::kEto: return 11;
    case BrlcadKind::kEhy: return 12;
    case BrlcadKind::kPart: return 8;
    case BrlcadKind::kSuperell: return 14;
    default: return 0;
  }
}

BrlcadPlace brlcad_place(const std::array<double, 16>& m) {
  const BrlcadPlace broken{std::nullopt, true};
  Affine map;
  const double most = kBrlcadMatrixTail * std::fabs(m[15]);
  for (const std::size_t i : {12u, 13u, 14u}) {
    if (!(std::fabs(m[i]) <= most)) return broken;
  }
  if (m[15] == 0) return broken;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      map.m[row][column] = m[4 * row + column] / m[15];
    }
  }
  if (!map.is_finite() || !map.inverse()) return broken;
  if (map == Affine{}) return {};
  return {map, false};
}

BrlcadMesh brlcad_ars_mesh(const std::vector<Vec3>& points, std::size_t curves,
                           std::size_t per_curve) {
  BrlcadMesh mesh;
  mesh.vertices = points;
  const auto index = [&](std::size_t curve, std::size_t point) {
    return static_cast<std::uint32_t>(curve * per_curve + point % per_curve);
  };
  for (std::size_t c = 0; c + 1 < curves; ++c) {
    for (std::size_t p = 0; p < per_curve; ++p) {
      mesh.faces.push_back({index(c, p), index(c, p + 1), index(c + 1, p)});
      mesh.faces.push_back({index(c, p + 1), index(c + 1, p + 1), index(c + 1, p)});
    }
  }
  return mesh;
}

std::optional<std::array<int, 3>> parse_brlcad_rgb(std::string_view text) {
  std::string spaced(text);
  std::replace(spaced.begin(), spaced.end(), '/', ' ');
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  const auto words = blank_separated(spaced, 4);
  if (words.size() != 3) return std::nullopt;
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto v = parse_brlcad_number(words[i]);
    if (!v) return std::nullopt;
    rgb[i] = static_cast<int>(std::clamp(*v, 0.0, 255.0));
  }
  return rgb;
}

void set_brlcad_attribute(BrlcadComb& comb, std::string_view name, std::string_view value) {
  const auto integer = [&] { return parse_brlcad_integer(value).value_or(0); };
  if (name == "region") {
    comb.is_region = true;
  } else if (name == "region_id" || name == "id") {
    comb.region_id = integer();
  } else if (name == "aircode" || name == "air") {
    comb.air = integer();
  } else if (name == "inherit") {
    comb.inherits = value == "yes" || (value != "no" && integer() != 0);
  } else if (name == "rgb" || name == "color") {
    comb.rgb = parse_brlcad_rgb(value);
  } else if (name == "oshader" || name == "shader") {
    comb.shader = value;
  }
}

namespace {

/// Reads any number of {low high r g b}.
void add_color_ranges(std::string_view table, std::vector<BrlcadColorRange>& colors) {
  constexpr std::size_t kMostDigits = 9;
  std::array<long, 5> entry{};
  std::size_t count = 0;
  for (std::size_t at = 0; at < table.size();) {
    const std::size_t from = table.find_first_of("-0123456789", at);
    if (from == std::string_view::npos) break;
    at = std::min(table.find_first_not_of("-0123456789", from), table.size());
    const auto v = parse_brlcad_integer(table.substr(from, std::min(at - from, kMostDigits)));
    entry[count++] = v.value_or(0);
    if (count < entry.size()) continue;
    count = 0;
    BrlcadColorRange& range = colors.emplace_back(BrlcadColorRange{entry[0], entry[1], {}});
    for (std::size_t i = 0; i < 3; ++i)
      range.rgb[i] = static_cast<int>(std::clamp(entry[2 + i], 0l, 255l));
  }
}

}  // namespace

void set_brlcad_global(BrlcadDatabase& database, std::string_view name, std::string_view value) {
  if (name == "title") database.title = value;
  if (name == "regionid_colortable") add_color_ranges(value, database.colors);
}

BrlcadDatabase read_brlcad_database(std::string_view bytes, BrlcadReport& report) {
  if (bytes.size() > kMaxBrlcadBytes) {
    report.error("", "the file has more than " + std::to_string(kMaxBrlcadBytes) + " bytes");
    return {};
  }
  constexpr int kHeaderObject = 1;
  if (bytes.size() > 1 && bytes[0] == 'v' && (bytes[1] & 3) == kHeaderObject) {
    return read_brlcad_binary(bytes, report);
  }
  // The second byte of version 4's first record is a unit of length, 0 to 9; text has a blank.
  constexpr char kMostUnits = 9;
  if (bytes.size() > 1 && bytes[0] == 'I' && bytes[1] >= 0 && bytes[1] <= kMostUnits) {
    return read_brlcad_v4_binary(bytes, report);
  }
  std::string_view text = bytes;
  while (!text.empty()) {
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    if (start == std::string_view::npos) break;
    text.remove_prefix(start);
    if (text.front() != '#') break;
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  }
  for (const std::string_view word : {"title", "put", "attr", "units", "color"}) {
    if (text.starts_with(word)) return read_brlcad_v5_text(bytes, report);
  }
  if (text.starts_with("I ")) return read_brlcad_v4_text(bytes, report);
  report.error(
      "",
      "this is no BRL-CAD database: expected a binary of version 4 or 5 (.g), or text (.asc) that "
      "begins with 'title', 'put' or an 'I' record");
  return {};
}

}  // namespace graycube

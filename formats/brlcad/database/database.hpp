// A BRL-CAD database as plain values, whichever of its formats it came from: solids with the
// numbers that version 5 stores, combinations as Boolean trees over names. Lengths are millimetres.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "formats/brlcad/database/report.hpp"
#include "formats/brlcad/database/tree.hpp"
#include "geometry/affine.hpp"
#include "geometry/vec.hpp"

namespace graycube {

inline constexpr std::size_t kMaxBrlcadBytes = std::size_t{1} << 30;
inline constexpr std::size_t kMaxBrlcadObjects = std::size_t{1} << 22;
/// Most numbers of one arbn or pipe; most vertices, and most faces, of one mesh.
inline constexpr std::size_t kMaxBrlcadNumbers = std::size_t{1} << 20;
inline constexpr std::size_t kMaxBrlcadVertices = std::size_t{1} << 24;

enum class BrlcadKind : std::uint8_t {
  kArb8,      // 8 corners
  kTgc,       // V H A B C D
  kEll,       // V A B C
  kTor,       // V, unit N, major, minor radius
  kHalf,      // unit N, distance
  kRpc,       // V H B, half width
  kRhc,       // V H B, half width, distance to the asymptotes
  kEpa,       // V H, unit A, radii
  kEhy,       // V H, unit A, radii, distance to the asymptotes
  kHyp,       // V H A, second radius, neck to base ratio
  kEto,       // V N C, radius of revolution, second radius
  kPart,      // V H, radii
  kArbn,      // planes N d
  kPipe,      // points: position, inner, outer diameter, bend radius
  kArs,       // mesh
  kBot,       // mesh
  kSuperell,  // V A B C, exponents n and e
};

struct BrlcadMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

struct BrlcadSolid {
  BrlcadKind kind = BrlcadKind::kEll;
  std::vector<double> values;
  BrlcadMesh mesh;
};

/// A solid of a kind that isn't read; `kind` is its name.
struct BrlcadForeign {
  std::string kind;
};

/// An object whose record can't be read; `why` says what is wrong with it.
struct BrlcadBroken {
  std::string why;
};

struct BrlcadComb {
  std::optional<BrlcadTree> tree;
  bool is_region = false;
  long region_id = 0, air = 0;
  bool inherits = false;
  std::optional<std::array<int, 3>> rgb;
  /// The shader's name and its parameters, as written.
  std::string shader;
};

using BrlcadValue = std::variant<BrlcadSolid, BrlcadComb, BrlcadForeign, BrlcadBroken>;

struct BrlcadObject {
  std::string name;
  /// The object's place in the file: "line 7" or "byte 4096".
  std::string where;
  BrlcadValue value;
};

/// Regions whose ids are low … high have this colour.
struct BrlcadColorRange {
  long low = 0, high = 0;
  std::array<int, 3> rgb{};
};

struct BrlcadDatabase {
  std::string title;
  std::vector<BrlcadObject> objects;
  std::unordered_map<std::string, std::size_t> by_name;
  std::vector<BrlcadColorRange> colors;

  const BrlcadObject* find(const std::string& name) const {
    const auto found = by_name.find(name);
    return found == by_name.end() ? nullptr : &objects[found->second];
  }
  BrlcadObject* find(const std::string& name) {
    return const_cast<BrlcadObject*>(std::as_const(*this).find(name));
  }
  /// A second object of a name replaces the first, as in BRL-CAD.
  void add(BrlcadObject object);
};

/// The count of numbers in a solid's record; 0 for kinds of which it varies.
std::size_t brlcad_value_count(BrlcadKind kind);

/// The first three numbers of a matrix's last row are 0 in an affine map. In real files they are
/// off by some 1e-9; up to this part of the last number they count as 0. Their effect is less than
/// a thousandth of a model's coordinates up to 10 m from the origin.
inline constexpr double kBrlcadMatrixTail = 1e-7;
/// Reads a 4 × 4 matrix by rows, its last element dividing. Broken when it is no invertible affine
/// map.
BrlcadPlace brlcad_place(const std::array<double, 16>& m);

/// The points of an ars: `curves` polylines of `points` points each, the first and the last of them
/// collapsed to a point, as a mesh.
BrlcadMesh brlcad_ars_mesh(const std::vector<Vec3>& points, std::size_t curves,
                           std::size_t per_curve);

/// Reads any of the formats: .asc or .g, of version 4 or 5. Objects that can't be read are kept as
/// broken ones; errors of the file as a whole, and warnings, go to the report.
BrlcadDatabase read_brlcad_database(std::string_view bytes, BrlcadReport& report);

// The readers of the single formats.
BrlcadDatabase read_brlcad_v4_text(std::string_view text, BrlcadReport& report);
BrlcadDatabase read_brlcad_v5_text(std::string_view text, BrlcadReport& report);
BrlcadDatabase read_brlcad_binary(std::string_view bytes, BrlcadReport& report);
BrlcadDatabase read_brlcad_v4_binary(std::string_view bytes, BrlcadReport& report);

/// Sets an attribute as version 5 names it (`rgb`, `oshader`, `region`, …); unknown ones are
/// ignored.
void set_brlcad_attribute(BrlcadComb& comb, std::string_view name, std::string_view value);
/// The same for the attributes of the database itself, `_GLOBAL`: `title` and
/// `regionid_colortable`.
void set_brlcad_global(BrlcadDatabase& database, std::string_view name, std::string_view value);
/// "r/g/b" or "r g b", 0 … 255 each; nothing otherwise.
std::optional<std::array<int, 3>> parse_brlcad_rgb(std::string_view text);

}  // namespace graycube

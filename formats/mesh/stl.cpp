#include "formats/mesh/stl.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "formats/mesh/words.hpp"

namespace graycube {
namespace {

constexpr std::size_t kStlHeadBytes = 84, kStlFacetBytes = 50, kStlNormalBytes = 12;

std::uint32_t little_u32(std::string_view bytes) {
  std::uint32_t v = 0;
  for (std::size_t i = 4; i-- > 0;) v = v << 8 | static_cast<unsigned char>(bytes[i]);
  return v;
}

void add_triangle(PolygonMesh& mesh) {
  const auto n = static_cast<std::uint32_t>(mesh.points.size());
  mesh.add_face(std::array{n - 3, n - 2, n - 1});
}

/// The most facets of a file, as all their corners must be held until they are welded.
constexpr std::size_t kMaxFacets = kMaxMeshPoints / 3;

MeshFault too_many_facets(std::size_t found) {
  return {"at most " + std::to_string(kMaxFacets) + " facets are accepted, found " +
          std::to_string(found)};
}

std::variant<PolygonMesh, MeshFault> read_binary_stl(std::string_view bytes) {
  const std::size_t facets = little_u32(bytes.substr(80));
  if ((bytes.size() - kStlHeadBytes) / kStlFacetBytes < facets) {
    return MeshFault{"binary STL with " + std::to_string(facets) +
                     " facets announced and bytes for " +
                     std::to_string((bytes.size() - kStlHeadBytes) / kStlFacetBytes)};
  }
  if (facets > kMaxFacets) return too_many_facets(facets);
  PolygonMesh mesh;
  mesh.digits = kSinglePrecisionDigits;
  mesh.points.reserve(3 * facets);
  for (std::size_t f = 0; f < facets; ++f) {
    std::string_view at = bytes.substr(kStlHeadBytes + f * kStlFacetBytes + kStlNormalBytes);
    for (int corner = 0; corner < 3; ++corner) {
      Vec3& p = mesh.points.emplace_back();
      for (int a = 0; a < 3; ++a) {
        p[a] = static_cast<double>(std::bit_cast<float>(little_u32(at)));
        at.remove_prefix(4);
      }
    }
    add_triangle(mesh);
  }
  return mesh;
}

/// Reads one facet behind the word "facet".
std::optional<MeshFault> read_facet(Words& words, PolygonMesh& mesh) {
  const auto expect = [&](std::string_view word) { return equal_words(words.next(), word); };
  if (!expect("normal")) return words.fault("expected a facet's normal");
  for (int a = 0; a < 3; ++a) {
    // The normal's words need not be numbers: some programs write nan for the normal of a sliver.
    if (words.next().empty()) return words.fault("expected a facet's normal");
  }
  if (!expect("outer") || !expect("loop")) return words.fault("expected \"outer loop\"");
  for (int corner = 0; corner < 3; ++corner) {
    if (!expect("vertex")) return words.fault("expected a \"vertex\"");
    Vec3& p = mesh.points.emplace_back();
    for (int a = 0; a < 3; ++a) {
      if (!words.read(p[a])) return words.fault("expected a vertex's three numbers");
    }
  }
  if (!expect("endloop") || !expect("endfacet"))
    return words.fault("expected \"endloop\" and \"endfacet\"");
  add_triangle(mesh);
  return std::nullopt;
}

std::variant<PolygonMesh, MeshFault> read_ascii_stl(std::string_view text) {
  Words words(text);
  PolygonMesh mesh;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    // Names are skipped, as they may be anything, and there may be several solids.
    if (equal_words(word, "solid") || equal_words(word, "endsolid")) {
      words.skip_line();
    } else if (equal_words(word, "facet")) {
      if (mesh.face_ends.size() == kMaxFacets) return too_many_facets(mesh.face_ends.size() + 1);
      if (auto fault = read_facet(words, mesh)) return *std::move(fault);
    } else {
      return words.fault("expected \"facet\" or \"endsolid\"");
    }
  }
  mesh.digits = words.digits();
  return mesh;
}

}  // namespace

std::variant<PolygonMesh, MeshFault> read_stl(std::string_view bytes) {
  // Binary files may begin with "solid" too: their size tells which they are.
  const bool has_head = bytes.size() >= kStlHeadBytes;
  const auto announced = [&] {
    return kStlHeadBytes + std::uint64_t{little_u32(bytes.substr(80))} * kStlFacetBytes;
  };
  if (has_head && bytes.size() == announced()) return read_binary_stl(bytes);
  if (equal_words(Words(bytes).next(), "solid")) return read_ascii_stl(bytes);
  if (has_head) return read_binary_stl(bytes);
  return MeshFault{"neither binary nor ASCII STL"};
}

}  // namespace graycube

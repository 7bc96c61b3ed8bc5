#include "formats/mesh/stl.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "formats/mesh/words.hpp"
#include "mesh/face_limits.hpp"

namespace graycube {
namespace {

constexpr std::size_t kHeadBytes = 84, kFacetBytes = 50, kNormalBytes = 12;
/// The first bytes of a file, by which text is told from numbers.
constexpr std::size_t kLookedAt = 512;
/// Words between "normal" and "outer": three numbers, or what a program writes for lack of them.
constexpr std::size_t kMaxNormalWords = 8;

/// The most facets of a file, as all their corners must be held until they are welded.
constexpr std::size_t kMaxFacets = kMaxMeshPoints / 3;

MeshFault too_many_facets(std::size_t found) {
  return {"at most " + std::to_string(kMaxFacets) + " facets are accepted, found " +
          std::to_string(found)};
}

std::uint32_t little_u32(std::string_view bytes) {
  std::uint32_t v = 0;
  for (std::size_t i = 4; i-- > 0;) v = v << 8 | static_cast<unsigned char>(bytes[i]);
  return v;
}

using Parts = std::variant<std::vector<MeshPart>, MeshFault>;

Parts read_binary(std::string_view bytes) {
  const std::size_t announced = little_u32(bytes.substr(80));
  const std::size_t there = (bytes.size() - kHeadBytes) / kFacetBytes;
  const bool is_whole = (bytes.size() - kHeadBytes) % kFacetBytes == 0 && there > 0;
  if (!is_whole && there < announced) {
    return MeshFault{"binary STL with " + std::to_string(announced) +
                     " facets announced and bytes for " + std::to_string(there)};
  }
  const std::size_t facets = is_whole || announced == 0 ? there : announced;
  if (facets > kMaxFacets) return too_many_facets(facets);
  MeshPart part;
  PolygonMesh& mesh = part.polygons;
  mesh.digits = kSinglePrecisionDigits;
  mesh.points.reserve(3 * facets);
  for (std::size_t f = 0; f < facets; ++f) {
    std::string_view at = bytes.substr(kHeadBytes + f * kFacetBytes + kNormalBytes);
    for (int corner = 0; corner < 3; ++corner) {
      Vec3& p = mesh.points.emplace_back();
      for (int a = 0; a < 3; ++a) {
        p[a] = static_cast<double>(std::bit_cast<float>(little_u32(at)));
        at.remove_prefix(4);
      }
    }
    const auto n = static_cast<std::uint32_t>(mesh.points.size());
    mesh.add_face(std::array{n - 3, n - 2, n - 1});
  }
  return std::vector<MeshPart>{std::move(part)};
}

/// Reads an ASCII file word by word.
class AsciiReader {
 public:
  explicit AsciiReader(std::string_view text) : words_(text) {}

  Parts read() {
    for (std::string_view word = keyword(); !word.empty(); word = keyword()) {
      if (equal_words(word, "facet")) {
        if (parts_.empty()) parts_.emplace_back();
        if (auto fault = read_facet(parts_.back().polygons)) return *std::move(fault);
      } else if (equal_words(word, "solid")) {
        if (auto fault = begin_solid()) return *std::move(fault);
      } else if (equal_words(word, "endsolid") || equal_words(word, "end") ||
                 equal_words(word, "color")) {
        skip_name();
      } else {
        return words_.expected("\"facet\" or \"endsolid\"");
      }
    }
    // The digits are those of the file: short numbers of one solid say nothing.
    for (MeshPart& part : parts_) part.polygons.digits = words_.digits();
    return std::move(parts_);
  }

 private:
  /// The next word that is no comment; empty at the end.
  std::string_view keyword() {
    std::string_view word = words_.next();
    while (word.starts_with('#') || word.starts_with(';') || word.starts_with("//")) {
      words_.skip_line();
      word = words_.next();
    }
    return word;
  }

  std::optional<MeshFault> begin_solid() {
    if (parts_.size() == kMaxMeshParts)
      return words_.fault("more than " + std::to_string(kMaxMeshParts) + " solids");
    const Words before = words_;
    skip_name();
    parts_.emplace_back().name = mesh_name(before.text_up_to(words_));
    return std::nullopt;
  }

  /// Goes on to the next line, or to a facet on this one: some files are a single line. Names may
  /// hold any words.
  void skip_name() {
    while (!words_.at_line_end()) {
      const Words before = words_;
      if (!equal_words(words_.next(), "facet")) continue;
      const std::string_view word = Words(words_).next();
      if (equal_words(word, "normal") || equal_words(word, "outer")) {
        words_ = before;
        return;
      }
    }
  }

  /// Reads one facet behind the word "facet".
  std::optional<MeshFault> read_facet(PolygonMesh& mesh) {
    std::string_view word = keyword();
    if (equal_words(word, "normal")) {
      // The normal's words need not be numbers: some programs write nan for that of a sliver.
      word = keyword();
      for (std::size_t n = 0; n < kMaxNormalWords && !begins_loop(word); ++n) word = keyword();
    }
    if (!begins_loop(word)) return words_.expected("\"outer loop\"");
    if (equal_words(word, "outer") && !equal_words(keyword(), "loop"))
      return words_.expected("\"outer loop\"");
    if (!equal_words(word, "vertex")) word = keyword();
    if (auto fault = read_corners(word, mesh)) return fault;
    return read_end(word);
  }
  static bool begins_loop(std::string_view word) {
    return equal_words(word, "outer") || equal_words(word, "outerloop") ||
           equal_words(word, "vertex");
  }

  /// Reads the corners from the word "vertex" on; then `word` is the one behind them.
  std::optional<MeshFault> read_corners(std::string_view& word, PolygonMesh& mesh) {
    face_.clear();
    for (; equal_words(word, "vertex"); word = keyword()) {
      if (face_.size() == kMostFaceCorners)
        return words_.fault("more than " + std::to_string(kMostFaceCorners) + " corners");
      if (points_ == 3 * kMaxFacets) return too_many_facets(kMaxFacets + 1);
      Vec3 p;
      for (int a = 0; a < 3; ++a) {
        if (!words_.read(p[a])) return words_.expected("a vertex's three numbers");
      }
      ++points_;
      face_.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      mesh.points.push_back(p);
    }
    if (face_.size() < 3) return words_.expected("a \"vertex\"");
    mesh.add_face(face_);
    return std::nullopt;
  }

  /// Reads what ends a loop and a facet, `word` being the first of it; some write "end loop".
  std::optional<MeshFault> read_end(std::string_view word) {
    const auto is_end = [&](std::string_view of) {
      if (equal_words(word, "end")) return equal_words(keyword(), of);
      return word.size() > 3 && equal_words(word.substr(0, 3), "end") &&
             equal_words(word.substr(3), of);
    };
    if (!is_end("loop")) return words_.expected("\"endloop\"");
    word = keyword();
    if (!is_end("facet")) return words_.expected("\"endfacet\"");
    return std::nullopt;
  }

  Words words_;
  std::vector<MeshPart> parts_;
  std::vector<std::uint32_t> face_;
  std::size_t points_ = 0;
};

/// Whether the file's first bytes are those of a text: no control characters but spaces.
bool looks_like_text(std::string_view bytes) {
  return std::ranges::none_of(bytes.substr(0, kLookedAt), [](char c) {
    return (c >= '\0' && c < '\t') || (c > '\r' && c < ' ' && c != '\x1A');
  });
}

/// Whether a text begins as ASCII STL does: with its first words, or a comment before them.
bool begins_as_ascii(std::string_view bytes) {
  const std::string_view word = Words(bytes).next();
  return equal_words(word, "solid") || equal_words(word, "facet") || word.starts_with('#') ||
         word.starts_with(';') || word.starts_with("//");
}

}  // namespace

Parts read_stl(std::string_view bytes) {
  if (std::string problem = problem_of_encoding(bytes); !problem.empty())
    return MeshFault{std::move(problem)};
  // Binary files may begin with "solid" too: their size or their bytes tell which they are.
  const bool has_head = bytes.size() >= kHeadBytes;
  const auto announced = [&] {
    return kHeadBytes + std::uint64_t{little_u32(bytes.substr(80))} * kFacetBytes;
  };
  const bool is_binary = has_head && (bytes.size() == announced() || !looks_like_text(bytes));
  if (is_binary) return read_binary(bytes);
  if (begins_as_ascii(bytes)) return AsciiReader(bytes).read();
  return Words(bytes).next().empty()
             ? MeshFault{"neither binary nor ASCII STL: there is nothing in it"}
             : MeshFault{"neither binary nor ASCII STL: a text that doesn't begin with \"solid\""};
}

}  // namespace graycube

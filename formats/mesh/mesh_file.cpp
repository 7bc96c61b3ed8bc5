#include "formats/mesh/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

#include "written_digits.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kStlHeadBytes = 84, kStlFacetBytes = 50, kStlNormalBytes = 12;

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
bool equal_words(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

/// Cuts a text into words, and counts lines.
class Words {
 public:
  explicit Words(std::string_view text, char comment = '\0') : text_(text), comment_(comment) {}

  /// The next word; empty at the end.
  std::string_view next() {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_]) &&
           (comment_ == '\0' || text_[at_] != comment_))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  /// Whether the rest of this line holds no word.
  bool at_line_end() {
    while (at_ < text_.size() && text_[at_] != '\n' && is_space(text_[at_])) ++at_;
    return at_ == text_.size() || text_[at_] == '\n' || text_[at_] == comment_;
  }
  bool read(double& out) {
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    if (error != std::errc{} || end != word.data() + word.size() || word.empty()) return false;
    digits_.see(word, out);
    return true;
  }
  bool read(std::uint32_t& out) {
    const std::string_view word = next();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    return error == std::errc{} && end == word.data() + word.size() && !word.empty();
  }
  MeshFault fault(const std::string& why) const {
    return {"line " + std::to_string(line_) + ": " + why};
  }
  std::size_t left() const { return text_.size() - at_; }
  /// The most significant digits that any double read so far was written with.
  std::uint32_t digits() const { return digits_.most(); }

 private:
  void skip() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (comment_ != '\0' && c == comment_) {
        skip_line();
      } else if (is_space(c)) {
        if (c == '\n') ++line_;
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  char comment_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
  WrittenDigits digits_;
};

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

std::optional<MeshFault> read_off_face(Words& words, PolygonMesh& mesh,
                                       std::vector<std::uint32_t>& face) {
  std::uint32_t corners = 0;
  if (!words.read(corners)) return words.fault("expected a face's number of corners");
  if (corners < 3 || corners > kMaxFaceCorners) {
    return words.fault("expected a face of 3 to " + std::to_string(kMaxFaceCorners) + " corners");
  }
  face.resize(corners);
  for (std::uint32_t& i : face) {
    if (!words.read(i)) return words.fault("expected the numbers of a face's points");
    if (i >= mesh.points.size()) {
      return words.fault("no point " + std::to_string(i) + ", there are " +
                         std::to_string(mesh.points.size()));
    }
  }
  mesh.add_face(face);
  words.skip_line();  // perhaps a colour
  return std::nullopt;
}

std::string read_whole(const fs::path& path, std::optional<MeshFault>& fault) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error) {
    fault = MeshFault{"can't be read: " + error.message()};
  } else if (size > kMaxMeshFileBytes) {
    fault = MeshFault{"larger than " + std::to_string(kMaxMeshFileBytes) + " bytes"};
  }
  if (fault) return {};
  std::string bytes(size, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!file) fault = MeshFault{"can't be read"};
  return bytes;
}

std::string lower_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), lower);
  return ending;
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

std::variant<PolygonMesh, MeshFault> read_off(std::string_view text) {
  Words words(text, '#');
  if (!equal_words(words.next(), "OFF")) return words.fault("expected \"OFF\"");
  std::uint32_t points = 0, faces = 0, edges = 0;
  if (!words.read(points) || !words.read(faces))
    return words.fault("expected the numbers of points, faces and edges");
  if (!words.at_line_end() && !words.read(edges))
    return words.fault("expected the number of edges");
  // Each point and each face takes six characters at least.
  if (points > kMaxMeshPoints || faces > kMaxMeshTriangles ||
      (std::uint64_t{points} + faces) * 6 > words.left() + 6) {
    return words.fault("more points or faces than are accepted or can follow: " +
                       std::to_string(points) + " and " + std::to_string(faces));
  }
  PolygonMesh mesh;
  mesh.points.resize(points);
  for (Vec3& p : mesh.points) {
    for (int a = 0; a < 3; ++a) {
      if (!words.read(p[a])) return words.fault("expected a point's three numbers");
    }
  }
  mesh.digits = words.digits();
  std::vector<std::uint32_t> face;
  for (std::uint32_t f = 0; f < faces; ++f) {
    if (auto fault = read_off_face(words, mesh, face)) return *std::move(fault);
  }
  return mesh;
}

bool is_mesh_file(const fs::path& path) {
  const std::string ending = lower_ending(path);
  return ending == ".stl" || ending == ".off";
}

std::variant<MeshShape, MeshFault> read_mesh_file(const fs::path& path) {
  const auto here = [&](MeshFault fault) { return MeshFault{path.string() + ": " + fault.why}; };
  if (!is_mesh_file(path)) return here({"expected a name ending in .stl or .off"});
  std::optional<MeshFault> fault;
  const std::string bytes = read_whole(path, fault);
  if (fault) return here(*std::move(fault));
  auto polygons = lower_ending(path) == ".stl" ? read_stl(bytes) : read_off(bytes);
  if (auto* wrong = std::get_if<MeshFault>(&polygons)) return here(std::move(*wrong));
  auto closed = closed_mesh(std::get<PolygonMesh>(polygons));
  if (auto* wrong = std::get_if<MeshFault>(&closed)) return here(std::move(*wrong));
  return MeshShape{std::get<TriangleMesh>(std::move(closed)),
                   std::get<PolygonMesh>(polygons).digits};
}

MeshLoader mesh_files_beside(const fs::path& scene_file) {
  return [folder = scene_file.parent_path()](std::string_view file) {
    return read_mesh_file(folder / fs::path(file));
  };
}

}  // namespace graycube

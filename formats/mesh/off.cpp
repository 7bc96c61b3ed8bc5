#include "formats/mesh/off.hpp"

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/mesh/words.hpp"
#include "mesh/face_limits.hpp"

namespace graycube {
namespace {

/// What the first word announces.
struct Header {
  bool has_textures = false, has_colors = false, has_normals = false, has_fourth = false,
       has_dimensions = false, is_binary = false;

  std::size_t coordinates() const { return has_fourth ? 4 : 3; }
  /// Numbers of a point beyond its coordinates.
  std::size_t extras() const {
    return (has_normals ? 3u : 0u) + (has_colors ? 4u : 0u) + (has_textures ? 2u : 0u);
  }
};

/// The header that a word like "STCN4nOFF" stands for; the letters may come in any order.
std::optional<Header> header_of(std::string_view word) {
  if (word.size() < 3 || !equal_words(word.substr(word.size() - 3), "OFF")) return std::nullopt;
  // Only its case tells dimensions from normals, and only beside capitals.
  const bool has_case = word.ends_with("OFF");
  word.remove_suffix(3);
  Header header;
  const auto take = [&](std::string_view letters, bool& announced) {
    if (announced || !equal_words(word.substr(0, letters.size()), letters)) return false;
    word.remove_prefix(letters.size());
    return announced = true;
  };
  while (!word.empty()) {
    const bool is_small = has_case && word.starts_with('n');
    const bool is_known = take("ST", header.has_textures) || take("C", header.has_colors) ||
                          take("4", header.has_fourth) ||
                          take("N", is_small ? header.has_dimensions : header.has_normals);
    if (!is_known) return std::nullopt;
  }
  return header;
}

/// The coordinates of a point, the fourth dividing the others.
Vec3 point_of(const double (&v)[4], const Header& header) {
  const Vec3 p{v[0], v[1], v[2]};
  return header.has_fourth ? Vec3{p.x / v[3], p.y / v[3], p.z / v[3]} : p;
}

MeshFault bad_dimensions(std::uint32_t found) {
  return {"a mesh in " + std::to_string(found) + " dimensions, only 3 are read"};
}
MeshFault too_many(std::uint64_t points, std::uint64_t faces) {
  return {"more points or faces than are accepted or can follow: " + std::to_string(points) +
          " and " + std::to_string(faces)};
}
MeshFault no_point(std::uint32_t found, std::size_t there) {
  return {"no point " + std::to_string(found) + ", there are " + std::to_string(there)};
}

/// Whether each point, and each face, begins a line, so that all else on it can be skipped.
struct Lines {
  bool of_points, of_faces;
};

/// Reads what follows the header of a text, with words arranged in one of the ways above.
class TextReader {
 public:
  TextReader(Words words, const Header& header, Lines lines)
      : words_(words), header_(header), lines_(lines) {}

  std::variant<PolygonMesh, MeshFault> read() {
    if (auto fault = read_counts()) return *std::move(fault);
    mesh_.points.resize(points_);
    for (Vec3& p : mesh_.points) {
      if (auto fault = read_point(p)) return *std::move(fault);
    }
    mesh_.digits = words_.digits();
    for (std::uint32_t f = 0; f < faces_; ++f) {
      if (auto fault = read_face()) return *std::move(fault);
    }
    return std::move(mesh_);
  }

  /// How far it got.
  std::size_t position() const { return words_.position(); }

 private:
  std::optional<MeshFault> read_counts() {
    std::uint32_t dimensions = 3, edges = 0;
    if (header_.has_dimensions && !words_.read(dimensions))
      return words_.expected("the number of dimensions");
    if (dimensions != 3) return words_.fault(bad_dimensions(dimensions).why);
    if (!words_.read(points_) || !words_.read(faces_))
      return words_.expected("the numbers of points, faces and edges");
    if (!words_.at_line_end() && !words_.read(edges)) return words_.expected("the number of edges");
    // Each point takes six characters at least, each face two, with one space less in all.
    if (points_ > kMaxMeshPoints || faces_ > kMaxMeshTriangles ||
        std::uint64_t{points_} * 6 + std::uint64_t{faces_} * 2 > words_.left() + 2) {
      return words_.fault(too_many(points_, faces_).why);
    }
    return std::nullopt;
  }

  std::optional<MeshFault> read_point(Vec3& p) {
    double v[4] = {0, 0, 0, 1}, extra = 0;
    for (std::size_t i = 0; i < header_.coordinates(); ++i) {
      // A short line isn't filled up from the next one.
      if ((lines_.of_points && i > 0 && words_.at_line_end()) || !words_.read(v[i]))
        return words_.expected("a point's three numbers");
    }
    p = point_of(v, header_);
    if (lines_.of_points) {
      words_.skip_line();
      return std::nullopt;
    }
    for (std::size_t i = 0; i < header_.extras(); ++i) {
      if (!words_.read(extra)) return words_.expected("a point's normal, colour or texture");
    }
    return std::nullopt;
  }

  std::optional<MeshFault> read_face() {
    std::uint32_t corners = 0;
    if (!words_.read(corners)) return words_.expected("a face's number of corners");
    if (corners > kMostFaceCorners) {
      return words_.fault("expected a face of at most " + std::to_string(kMostFaceCorners) +
                          " corners");
    }
    face_.resize(corners);
    for (std::uint32_t& i : face_) {
      if (!words_.read(i)) return words_.expected("the numbers of a face's points");
      if (i >= mesh_.points.size()) return words_.fault(no_point(i, mesh_.points.size()).why);
    }
    if (corners >= 3) mesh_.add_face(face_);
    if (lines_.of_faces) words_.skip_line();
    return std::nullopt;
  }

  Words words_;
  Header header_;
  Lines lines_;
  std::uint32_t points_ = 0, faces_ = 0;
  PolygonMesh mesh_;
  std::vector<std::uint32_t> face_;
};

/// Tries the ways in which words may be arranged in lines; only one makes sense of a file.
std::variant<PolygonMesh, MeshFault> read_text(const Words& words, const Header& header) {
  std::variant<PolygonMesh, MeshFault> best = MeshFault{};
  std::size_t farthest = 0;
  for (const Lines lines : {Lines{true, true}, Lines{false, true}, Lines{false, false}}) {
    TextReader reader(words, header, lines);
    auto read = reader.read();
    if (std::holds_alternative<PolygonMesh>(read)) return read;
    if (farthest == 0 || reader.position() > farthest) {
      farthest = reader.position();
      best = std::move(read);
    }
  }
  return best;
}

/// Reads what follows the header of a binary file: 32 bits a number, the highest first.
class BinaryReader {
 public:
  BinaryReader(std::string_view bytes, const Header& header) : bytes_(bytes), header_(header) {}

  std::variant<PolygonMesh, MeshFault> read() {
    std::uint32_t dimensions = 3, points = 0, faces = 0, edges = 0;
    if (header_.has_dimensions && !take(dimensions)) return cut_off();
    if (dimensions != 3) return bad_dimensions(dimensions);
    if (!take(points) || !take(faces) || !take(edges)) return cut_off();
    const std::size_t point_bytes = 4 * (header_.coordinates() + header_.extras());
    if (points > kMaxMeshPoints || faces > kMaxMeshTriangles ||
        std::uint64_t{points} * point_bytes + std::uint64_t{faces} * 8 > bytes_.size()) {
      return too_many(points, faces);
    }
    PolygonMesh mesh;
    mesh.digits = kSinglePrecisionDigits;
    mesh.points.reserve(points);
    for (std::uint32_t i = 0; i < points; ++i) mesh.points.push_back(take_point());
    std::vector<std::uint32_t> face;
    for (std::uint32_t f = 0; f < faces; ++f) {
      if (auto fault = read_face(mesh, face)) return *std::move(fault);
    }
    return mesh;
  }

 private:
  static MeshFault cut_off() { return {"binary OFF that ends too early"}; }

  bool take(std::uint32_t& out) {
    if (bytes_.size() < 4) return false;
    out = 0;
    for (std::size_t i = 0; i < 4; ++i) out = out << 8 | static_cast<unsigned char>(bytes_[i]);
    bytes_.remove_prefix(4);
    return true;
  }
  bool skip(std::uint32_t numbers) {
    if (bytes_.size() / 4 < numbers) return false;
    bytes_.remove_prefix(4 * std::size_t{numbers});
    return true;
  }
  /// Only for as many points as there are bytes.
  Vec3 take_point() {
    double v[4] = {0, 0, 0, 1};
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < header_.coordinates(); ++i) {
      take(bits);
      v[i] = static_cast<double>(std::bit_cast<float>(bits));
    }
    skip(static_cast<std::uint32_t>(header_.extras()));
    return point_of(v, header_);
  }
  std::optional<MeshFault> read_face(PolygonMesh& mesh, std::vector<std::uint32_t>& face) {
    std::uint32_t corners = 0, colors = 0;
    if (!take(corners)) return cut_off();
    if (corners > kMostFaceCorners) {
      return MeshFault{"a face of " + std::to_string(corners) + " corners, at most " +
                       std::to_string(kMostFaceCorners) + " are accepted"};
    }
    face.resize(corners);
    for (std::uint32_t& i : face) {
      if (!take(i)) return cut_off();
      if (i >= mesh.points.size()) return no_point(i, mesh.points.size());
    }
    if (!take(colors) || !skip(colors)) return cut_off();
    if (corners >= 3) mesh.add_face(face);
    return std::nullopt;
  }

  std::string_view bytes_;
  Header header_;
};

}  // namespace

std::variant<PolygonMesh, MeshFault> read_off(std::string_view bytes) {
  if (std::string problem = problem_of_encoding(bytes); !problem.empty())
    return MeshFault{std::move(problem)};
  const Words start(bytes, '#');
  Words words = start;
  const std::string_view word = words.next();
  auto header = header_of(word);
  if (!header) {
    // Geomview takes files without the word.
    const bool is_number = !word.empty() && word.find_first_not_of("0123456789") == word.npos;
    return is_number ? read_text(start, {}) : words.expected("\"OFF\"");
  }
  Words behind = words;
  if (words.at_line_end() || !equal_words(words.next(), "BINARY"))
    return read_text(behind, *header);
  words.skip_line();
  bytes.remove_prefix(words.position());
  if (bytes.starts_with('\r')) bytes.remove_prefix(1);
  if (bytes.starts_with('\n')) bytes.remove_prefix(1);
  return BinaryReader(bytes, *header).read();
}

}  // namespace graycube

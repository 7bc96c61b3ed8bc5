#include "formats/mesh/part_stream.hpp"

#include <cstring>
#include <type_traits>
#include <utility>

#include "written_digits.hpp"

namespace graycube {
namespace {

constexpr std::string_view kPartsMark = "graycube parts 1\n", kFaultMark = "graycube fault 1\n";
constexpr std::size_t kMaxFaultBytes = 4096;

class Writer {
 public:
  explicit Writer(std::string_view mark) : bytes_(mark) {}

  template <typename T>
  void put(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&v), sizeof v);
  }
  template <typename T>
  void put_list(const std::vector<T>& list) {
    put(static_cast<std::uint32_t>(list.size()));
    bytes_.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
  }
  void put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes_.append(text);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : bytes_(bytes) {}

  template <typename T>
  bool get(T& v) {
    if (bytes_.size() < sizeof v) return false;
    std::memcpy(&v, bytes_.data(), sizeof v);
    bytes_.remove_prefix(sizeof v);
    return true;
  }
  /// A list of at most so many; the bytes must be there before memory is taken.
  template <typename T>
  bool get_list(std::vector<T>& list, std::uint32_t most) {
    std::uint32_t count = 0;
    if (!get(count) || count > most || bytes_.size() / sizeof(T) < count) return false;
    list.resize(count);
    if (count > 0) std::memcpy(list.data(), bytes_.data(), count * sizeof(T));
    bytes_.remove_prefix(count * sizeof(T));
    return true;
  }
  bool get_text(std::string& text, std::size_t most) {
    std::uint32_t count = 0;
    if (!get(count) || count > most || bytes_.size() < count) return false;
    text = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return true;
  }
  bool is_at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

/// Whether faces end one after the other, the last with the last corner, and corners exist.
bool is_sound(const PolygonMesh& mesh) {
  std::uint32_t begin = 0;
  for (const std::uint32_t end : mesh.face_ends) {
    if (end <= begin || end > mesh.corners.size()) return false;
    begin = end;
  }
  for (const std::uint32_t c : mesh.corners) {
    if (c >= mesh.points.size()) return false;
  }
  return begin == mesh.corners.size();
}

bool get_color(Cursor& in, MeshPart& part) {
  std::uint8_t has_color = 0;
  std::array<double, 4> color{};
  if (!in.get(has_color) || has_color > 1) return false;
  if (has_color == 0) return true;
  if (!in.get(color)) return false;
  for (const double c : color) {
    if (!(c >= 0 && c <= 1)) return false;
  }
  part.color = color;
  return true;
}

/// What the parts of a file may have together: what a scene may have.
struct Allowance {
  std::uint32_t points = kMaxMeshPoints, faces = kMaxMeshTriangles, corners = 3 * kMaxMeshTriangles;
};

bool get_part(Cursor& in, MeshPart& part, Allowance& left) {
  PolygonMesh& mesh = part.polygons;
  if (!in.get_text(part.name, kMaxMeshNameBytes) || mesh_name(part.name) != part.name ||
      !get_color(in, part) || !in.get(mesh.digits) || mesh.digits > kMaxDigits ||
      !in.get_list(mesh.points, left.points) || !in.get_list(mesh.face_ends, left.faces) ||
      !in.get_list(mesh.corners, left.corners) || !is_sound(mesh)) {
    return false;
  }
  left.points -= static_cast<std::uint32_t>(mesh.points.size());
  left.faces -= static_cast<std::uint32_t>(mesh.face_ends.size());
  left.corners -= static_cast<std::uint32_t>(mesh.corners.size());
  return true;
}

}  // namespace

std::string encode_parts(const std::vector<MeshPart>& parts) {
  Writer out(kPartsMark);
  out.put(static_cast<std::uint32_t>(parts.size()));
  for (const MeshPart& part : parts) {
    out.put_text(part.name);
    out.put(static_cast<std::uint8_t>(part.color ? 1 : 0));
    if (part.color) out.put(*part.color);
    out.put(part.polygons.digits);
    out.put_list(part.polygons.points);
    out.put_list(part.polygons.face_ends);
    out.put_list(part.polygons.corners);
  }
  return out.take();
}

std::string encode_parts(const MeshFault& fault) {
  Writer out(kFaultMark);
  out.put_text(std::string_view(fault.why).substr(0, kMaxFaultBytes));
  return out.take();
}

std::variant<std::vector<MeshPart>, MeshFault> decode_parts(std::string_view bytes) {
  const MeshFault broken{"what was read of it is broken"};
  if (bytes.starts_with(kFaultMark)) {
    Cursor in(bytes.substr(kFaultMark.size()));
    MeshFault fault;
    return in.get_text(fault.why, kMaxFaultBytes) && !fault.why.empty() ? fault : broken;
  }
  std::uint32_t count = 0;
  if (!bytes.starts_with(kPartsMark)) return broken;
  Cursor in(bytes.substr(kPartsMark.size()));
  if (!in.get(count) || count > kMaxMeshParts) return broken;
  std::vector<MeshPart> parts;
  Allowance left;
  for (std::uint32_t p = 0; p < count; ++p) {
    if (!get_part(in, parts.emplace_back(), left)) return broken;
  }
  if (!in.is_at_end()) return broken;
  return parts;
}

}  // namespace graycube

// The scratch memory with which one evaluator walks a surface tree.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "crossings/mailbox.hpp"
#include "crossings/ray_packet.hpp"
#include "csg/model.hpp"

namespace graycube {

/// Remembers the spans of recent rays inside meshes that are parts of objects cut into cells: a ray
/// asks for them in each cell, and the rays of a packet ask in turn.
class MeshMemo {
 public:
  /// The spans from t = 0 on, which are all that walks look at.
  const Spans& spans(const Model& model, std::uint32_t primitive, const Ray& ray) {
    const Mesh& mesh = model.meshes[model.primitives[primitive].mesh];
    Entry& e = entries_[slot_of(primitive, ray)];
    if (!e.mesh.is_same_as(mesh) || !(e.ray == ray)) {
      e.spans = mesh.spans_ahead(ray, cuts_);
      e.mesh = mesh;
      e.ray = ray;
    }
    return e.spans;
  }

 private:
  static constexpr std::size_t kEntries = 64;
  struct Entry {
    /// Kept alive, so that no other mesh can take its place in memory and be taken for it.
    Mesh mesh;
    Ray ray;
    Spans spans;
  };

  static std::size_t slot_of(std::uint32_t primitive, const Ray& ray) {
    std::uint64_t h = primitive;
    for (const double v : {ray.direction.x, ray.direction.y, ray.origin.x}) {
      h = (h ^ std::bit_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h % kEntries);
  }

  std::vector<MeshCut> cuts_;
  std::array<Entry, kEntries> entries_;
};

/// Scratch and counts of one evaluator.
struct TreeScratch {
  /// A transparent surface that a shadow ray crosses, and which ray of a packet it is.
  struct Pane {
    std::size_t ray;
    double t;
    std::uint32_t object;
    double transmit;
  };
  std::vector<Pane> panes;

  std::vector<Mailbox::Event> events;
  std::vector<std::uint64_t> flags_before, flags_after;
  std::vector<MeshCut> cuts;
  /// The cuts of a mesh by each ray of a packet.
  std::array<std::vector<MeshCut>, RayPacket::kSize> packet_cuts;
  MeshMemo meshes;
  WalkCounts counts;
  /// The item that ended the last shadow ray in each octant of directions; tried first.
  std::array<std::uint32_t, 8> last_occluder{};
};

}  // namespace graycube

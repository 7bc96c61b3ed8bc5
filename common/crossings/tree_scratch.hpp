// What one evaluator needs to walk a surface tree.
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

/// Where the last rays are inside of meshes that are parts of objects cut into cells: a ray asks
/// for them in each cell, and a packet's rays ask in turn.
class MeshMemo {
 public:
  /// From t = 0 on, which is all that walks look at.
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
    /// Held, so that no other takes its place in memory.
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
  /// Of each ray of a packet.
  std::array<std::vector<MeshCut>, RayPacket::kSize> packet_cuts;
  MeshMemo meshes;
  WalkCounts counts;
  /// The item that ended the last shadow ray in each octant of directions; tried first.
  std::array<std::uint32_t, 8> last_occluder{};
};

}  // namespace graycube

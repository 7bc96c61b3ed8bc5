// The authors' own subdivision (Arnaldi, Priol and Bouatouch 1987): space as the camera sees it
// (screen_bsp.hpp), walked by links. In perspective there are two halves of space, in front of the
// eye and behind it; a ray that passes the plane z = 0 between them leaves one and enters the other
// as if it began there.
//
// A primary ray stays in one region of the screen. Where nothing shows it isn't shot; elsewhere
// its region is known, so that it needs no entry.
#pragma once

#include <optional>
#include <vector>

#include "subdivisions/frustum_order.hpp"
#include "subdivisions/leaf_entry.hpp"
#include "subdivisions/pieces.hpp"
#include "subdivisions/screen_bsp.hpp"
#include "subdivisions/subdivision.hpp"

namespace graycube {

class ArnaldiCells {
 public:
  ArnaldiCells(const Model& model, Entry entry);

  /// A half of space, or all of it, in its own coordinates.
  struct Half {
    Half(const Model& model, const CameraSpace& seen)
        : space(seen), bsp(build_screen_bsp(model, space)), outermost(bsp) {}

    CameraSpace space;
    Bsp bsp;
    OutermostLeaves outermost;
  };
  /// In front first; with an orthographic camera there is only one.
  const std::vector<Half>& halves() const { return halves_; }

  /// As pieces.hpp says.
  template <typename Visit>
  bool walk(const Ray& ray, double t0, double t1, Mailbox& mailbox, Visit&& visit) const {
    const FrustumOrder order(halves_[0].space, ray);
    if (halves_.size() == 1) return walk_half(halves_[0], order, ray, t0, t1, mailbox, visit);
    const auto in_front = [&](double from, double to) {
      return walk_half(halves_[0], order, ray, from, to, mailbox, visit);
    };
    const auto behind = [&](double from, double to) {
      if (!(from < to)) return true;
      const FrustumOrder backward(halves_[1].space, ray);
      return walk_half(halves_[1], backward, ray, from, to, mailbox, visit);
    };
    const double z = order.line().origin.z, dz = order.line().direction.z;
    if (dz == 0) return z >= 0 ? in_front(t0, t1) : behind(t0, t1);
    const double passed = -z / dz;
    const double before = passed < t1 ? passed : t1, after = passed > t0 ? passed : t0;
    return dz > 0 ? behind(t0, before) && in_front(after, t1)
                  : in_front(t0, before) && behind(after, t1);
  }

  const Model& model() const { return halves_[0].bsp.model(); }
  std::size_t cell_count() const;
  std::size_t memory_bytes() const;

 private:
  template <typename Visit>
  bool walk_half(const Half& half, const FrustumOrder& order, const Ray& ray, double t0, double t1,
                 Mailbox& mailbox, Visit&& visit) const {
    if (!(t0 < t1)) return true;
    WalkCounts& counts = mailbox.counts;
    const Bsp& bsp = half.bsp;
    const BspLeaf* first = nullptr;
    if (is_primary(half, order)) {
      const std::uint32_t region = screen_region(bsp, order, t0, counts);
      if (shows_nothing(bsp, region)) {
        ++counts.rays_not_shot;
        return true;
      }
      first = &leaf_at(bsp, region, order, t0, counts);
    } else {
      first = entry_ == Entry::kExtremal ? &half.outermost.enter(bsp, order, t0, counts)
                                         : &leaf_at(bsp, 0, order, t0, counts);
    }
    return walk_links(
        bsp, order, *first, t0, t1, counts, [&](const BspLeaf& leaf, double from, double to) {
          return visit(CellPiece(bsp.cell_programs(), leaf.programs(), ray, mailbox), from, to);
        });
  }

  /// Whether the ray stays in one region of the screen: it comes from the eye, or runs along the
  /// view.
  static bool is_primary(const Half& half, const FrustumOrder& order) {
    return half.space.is_perspective() ? order.line().origin == Vec3{} : order.is_along_view();
  }
  /// The root of the cells of the ray's region of the screen.
  static std::uint32_t screen_region(const Bsp& bsp, const FrustumOrder& order, double t,
                                     WalkCounts& counts) {
    std::uint32_t node = 0;
    while (bsp.nodes()[node].axis < 2) {
      ++counts.nodes_descended;
      const BspNode& n = bsp.nodes()[node];
      node = n.child + (order.is_above(n.axis, n.split, t) ? 1u : 0u);
    }
    return node;
  }
  static bool shows_nothing(const Bsp& bsp, std::uint32_t region) {
    const BspNode& n = bsp.nodes()[region];
    return n.axis == BspNode::kLeafAxis && bsp.leaves()[n.child].program_count == 0;
  }

  std::vector<Half> halves_;
  Entry entry_;
};

}  // namespace graycube

// Ray casting of CSG trees without a subdivision of space (Roth 1982): a ray visits every object's
// tree from the root, leaves out subtrees whose box or sphere it misses, classifies itself against
// the primitives at the leaves, and combines the lists of intervals on the way back up. A subtree
// is left out, too, when the operands before it have decided: the left one of an intersection or
// difference is empty, or that of a union everything. Trees are in negation normal form here, so
// that a difference is a conjunction with the complement's list.
#pragma once

#include <vector>

#include "crossings/crossings.hpp"
#include "subdivisions/bounding_volumes.hpp"
#include "subdivisions/span_list.hpp"

namespace graycube {

class RothObjects {
 public:
  explicit RothObjects(const Model& model) : model_(&model), volumes_(bounding_volumes_of(model)) {}

  /// All objects along the whole ray, in one piece.
  class Piece {
   public:
    Piece(const RothObjects& objects, const Ray& ray, Mailbox& mailbox)
        : objects_(objects), ray_(ray), mailbox_(mailbox) {}

    std::uint32_t count() const {
      return static_cast<std::uint32_t>(objects_.model_->objects.size());
    }
    template <typename Visit>
    bool for_each_crossing(std::uint32_t i, double t0, double t1, Visit&& visit) const {
      SpanStack& stack = mailbox_.span_ends;
      stack.clear();
      const SpanList list = objects_.list_of(objects_.model_->objects[i].first_node,
                                             {ray_, t0, t1, stack, mailbox_.counts});
      bool entering = !list.begins_inside;
      for (std::size_t k = list.first; k < list.end; ++k, entering = !entering) {
        if (!visit(Crossing{stack[k].t, stack[k].primitive, i, entering})) return false;
      }
      return true;
    }

   private:
    const RothObjects& objects_;
    BoundingRay ray_;
    Mailbox& mailbox_;
  };

  /// As pieces.hpp says.
  template <typename Visit>
  bool walk(const Ray& ray, double t0, double t1, Mailbox& mailbox, Visit&& visit) const {
    return !(t0 < t1) || visit(Piece(*this, ray, mailbox), t0, t1);
  }

  const Model& model() const { return *model_; }
  std::size_t cell_count() const { return 0; }
  std::size_t memory_bytes() const { return volumes_.capacity() * sizeof(BoundingVolumes); }

 private:
  /// What a ray is asked: its intervals with ends at t0 ≤ t < t1.
  struct Question {
    const BoundingRay& ray;
    double t0, t1;
    SpanStack& stack;
    WalkCounts& counts;
  };
  /// The list of the subtree at an index into Model::nodes, pushed onto the stack.
  SpanList list_of(std::size_t index, const Question& q) const;

  const Model* model_;
  std::vector<BoundingVolumes> volumes_;
};

}  // namespace graycube

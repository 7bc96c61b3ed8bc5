// What every subdivision of the report's time offers: the crossings of one ray after the other.
// Today's is not among them: a SurfaceTree takes packets of rays.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "crossings/crossings.hpp"
#include "crossings/mailbox.hpp"
#include "csg/model.hpp"
#include "subdivisions/subdivision.hpp"

namespace graycube {

/// Immutable once built; shared by all evaluator threads.
class CrossingSearch {
 public:
  virtual ~CrossingSearch() = default;

  /// The first crossing of any object with t0 ≤ t < t1; at equal t the first object wins. `mailbox`
  /// is the evaluator's own; the search begins a new ray in it.
  virtual std::optional<Crossing> first_crossing(const Ray& ray, double t0, double t1,
                                                 Mailbox& mailbox) const = 0;
  /// Lets a shadow ray's light through the surfaces crossed in [t0, t1): multiplies `light` by each
  /// transparent one's transmit, in order of t, then of the objects. False when an opaque one ends
  /// it.
  virtual bool pass_light(const Ray& ray, double t0, double t1, Mailbox& mailbox,
                          Rgb& light) const = 0;
  /// Leaf regions; 0 where space isn't subdivided.
  virtual std::size_t cell_count() const = 0;
  /// Bytes of what was built, without the model.
  virtual std::size_t memory_bytes() const = 0;
};

/// Builds what finds crossings in that way; not for kSurfaces. The model must outlive it.
std::unique_ptr<const CrossingSearch> make_search(const Model& model,
                                                  const SubdivisionChoice& choice);

}  // namespace graycube

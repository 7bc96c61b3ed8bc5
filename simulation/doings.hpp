// The work that brains and evaluators do, counted in units, each of which costs some CPU.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace graycube::simulation {

enum class Unit : std::uint8_t {
  kPiece,        ///< a piece of work taken by an evaluator
  kRay,          ///< a ray traced in it, received or created
  kVisit,        ///< a node of the subdivision visited
  kTest,         ///< a primitive tested
  kBuildByte,    ///< of a slice that was decoded and subdivided
  kNodeCall,     ///< an event in a node's brain
  kRayIn,        ///< a ray decoded and stored
  kRayOut,       ///< a ray stored and encoded
  kReturn,       ///< of light or credit, merged
  kLightByte,    ///< of contributions encoded
  kFrontalCall,  ///< an event in the frontal's brain
  kFrontalByte,  ///< of contributions decoded and added up
  kMessage,      ///< handed to or taken from the transport
  kMessageByte,  ///< of it
  kCipherByte,   ///< of it, if it goes to or comes from another host
  kWakeup,       ///< of a thread by another of its process
};
inline constexpr std::size_t kUnits = 16;

/// A number for each unit: how often something was done, or what it costs in CPU seconds.
struct PerUnit {
  std::array<double, kUnits> value{};

  double& operator[](Unit u) { return value[static_cast<std::size_t>(u)]; }
  double operator[](Unit u) const { return value[static_cast<std::size_t>(u)]; }
  void add(const PerUnit& o) {
    for (std::size_t i = 0; i < kUnits; ++i) value[i] += o.value[i];
  }
};

/// CPU seconds of the counted work at these costs.
inline double cost_of(const PerUnit& counts, const PerUnit& costs) {
  double sum = 0;
  for (std::size_t i = 0; i < kUnits; ++i) sum += counts.value[i] * costs.value[i];
  return sum;
}

}  // namespace graycube::simulation

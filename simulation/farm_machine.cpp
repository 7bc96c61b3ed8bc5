// What a simulated farm asks of its machine: cores, and what work and messages take.
#include "simulation/farm.hpp"
#include "simulation/message_doings.hpp"

namespace graycube::simulation {

Cores& Farm::cores_of(Place place) {
  if (machine_.shared_cores() > 0) return *cores_[machine_.host_of(place)];
  return *cores_[place ? place->value : processes_.size()];
}

/// The core seconds of a place's work, which are added to its account.
double Farm::take(Place place, const PerUnit& doings) {
  const double seconds = machine_.cpu_s(place, doings);
  (place ? processes_[place->value].cpu_s : frontal_cpu_s_) += seconds;
  return seconds;
}

/// One side's part of passing on a message from one place to another.
PerUnit Farm::passing(Place from, Place to, std::size_t bytes) const {
  return handling(bytes, machine_.host_of(from) != machine_.host_of(to));
}

/// The node that has, or had, that connection to the frontal.
Place Farm::place_of(const PeerId& peer) const {
  const auto found = peers_.find(peer);
  return found == peers_.end() ? Place{} : Place{found->second};
}

}  // namespace graycube::simulation

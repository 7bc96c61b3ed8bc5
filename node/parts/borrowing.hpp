// Shadows local: what has become of each other node's model, and the shadow rays that wait for it.
#pragma once

#include <cstdint>
#include <vector>

#include "node/parts/mail.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

class Borrowing {
 public:
  /// `is_on`: shadow rays are finished by who sent them. `room`: bytes of memory for others'
  /// models.
  Borrowing(std::uint32_t nodes, bool is_on, std::uint64_t room)
      : is_on_(is_on), room_(room), loans_(nodes) {}
  bool is_on() const { return is_on_; }

  /// How a ray goes on that lacks a node's model.
  enum class Place : std::uint8_t {
    kHere,   ///< the model is here meanwhile
    kWaits,  ///< it was taken over, until the model comes
    kThere,  ///< there is no memory for the model: with the neighbour whose region the ray has
             ///< entered
  };
  Place place_of(Rank owner, const RayTask& ray, Mail& mail);

  bool is_asked(Rank owner) const;
  /// The model is here and takes that much memory; returns the rays that have waited for it.
  std::vector<RayTask> came(Rank owner, std::uint64_t memory_bytes);
  /// The model will not come; returns the rays that have waited for it.
  std::vector<RayTask> was_refused(Rank owner);

  void report(control::NodeStats& stats) const { stats.models_borrowed += models_; }
  /// A new epoch: no ray waits, and what was asked for in the last one won't come.
  void reset();

 private:
  struct Loan {
    enum class State : std::uint8_t { kUnasked, kAsked, kHeld, kRefused };
    State state = State::kUnasked;
    std::vector<RayTask> waiting;
  };
  void ask(Rank owner, Mail& mail);

  bool is_on_;
  std::uint64_t room_;
  std::uint64_t models_ = 0;
  std::vector<Loan> loans_;  // by rank
};

}  // namespace graycube

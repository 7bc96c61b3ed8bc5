// Measures the costs of work on the processor at hand.
#pragma once

#include <string>

#include "proto/messages.hpp"
#include "simulation/cost_fit.hpp"

namespace graycube::simulation {

/// CPU seconds that measuring a piece of work adds to it.
double measuring_overhead_s();

/// CPU seconds of one side for each message, and for each byte of it, through real sockets:
/// kMessage and kMessageByte; and of waking a thread: kWakeup. Throws TransportError.
PerUnit transport_costs();

/// Renders the scene on a few simulated nodes and measures every piece of work: all costs but the
/// transport's. If flow is blocking, queues are as long as they can be, so that no job ends
/// early.
PerUnit measured_costs(const std::string& scene_text, control::JobOptions options,
                       std::uint32_t nodes);

}  // namespace graycube::simulation

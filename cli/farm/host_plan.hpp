// Where a farm's nodes are going to run, and what its frontal must be told for that.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/farm/allocation.hpp"
#include "cli/farm/farm_kind.hpp"

namespace graycube {

struct HostPlan {
  /// kLocal, kJoined or kSlurm.
  FarmKind kind = FarmKind::kLocal;
  std::uint32_t nodes = 1;
  /// The endpoint for clients and hosts; empty for the default one.
  std::string listen;
  /// The frontal's arguments beyond those of any farm.
  std::vector<std::string> arguments;
  std::optional<Allocation> allocation;
};

/// `nodes`: as many as were asked for, 0 for what is usual; `listen`: empty for what is usual.
/// Throws a Failure when there can be no such farm here.
HostPlan plan_hosts(FarmKind kind, std::uint32_t nodes, const std::string& listen);

}  // namespace graycube

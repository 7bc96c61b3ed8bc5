// Who runs a farm's nodes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace graycube {

enum class FarmKind : std::uint8_t {
  kAuto,    ///< kSlurm inside an allocation of Slurm, else kLocal
  kLocal,   ///< this machine
  kJoined,  ///< hosts that join
  kSlurm,   ///< the hosts of the allocation that this command runs in
};

constexpr std::string_view to_string(FarmKind kind) {
  constexpr std::array<std::string_view, 4> kNames{"auto", "local", "joined", "slurm"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace graycube

// Meshes as bytes, for the way from the program that reads foreign files to the command.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "formats/mesh/mesh_parts.hpp"

namespace graycube {

/// More bytes than any parts within the limits of meshes take.
inline constexpr std::uint64_t kMaxPartStreamBytes = std::uint64_t{1} << 30;

/// Writes parts, or why there are none. Numbers are as this machine has them in memory.
std::string encode_parts(const std::vector<MeshPart>& parts);
std::string encode_parts(const MeshFault& fault);

/// Reads what encode_parts() wrote. Bytes that are anything else are a fault, whatever they are.
/// In what is read, faces have corners that exist, and all parts are within the limits of a scene.
std::variant<std::vector<MeshPart>, MeshFault> decode_parts(std::string_view bytes);

}  // namespace graycube

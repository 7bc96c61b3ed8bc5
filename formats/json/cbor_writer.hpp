// JSON as CBOR (RFC 8949): the compact twin of a scene file.
#pragma once

#include <string>

#include "formats/json/tree.hpp"

namespace graycube {

/// The tree, which must hold no syntax error: the self-describing tag, then maps, arrays, UTF-8
/// strings and numbers, each in the shortest form that keeps its value. Keys keep their order.
std::string cbor_of(const JsonTree& tree);

}  // namespace graycube

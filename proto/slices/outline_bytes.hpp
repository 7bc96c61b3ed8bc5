// The outline of a lathe or a sweep as bytes; FORMAT.md describes them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "outline/outline.hpp"
#include "proto/bytes.hpp"

namespace graycube {

std::size_t segment_count(const Outline& outline);
std::size_t outline_bytes(const Outline& outline);
void put_outline(ByteWriter& w, const Outline& outline);
/// Reads an outline and adds its segments to `segments`, those of the slice so far. Returns what is
/// wrong, null if nothing is; too few bytes show in the reader alone.
const char* get_outline(ByteReader& r, std::uint64_t& segments, Outline& out);

}  // namespace graycube

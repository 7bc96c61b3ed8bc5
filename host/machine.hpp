// What a machine has for nodes.
#pragma once

#include <cstdint>
#include <string>

namespace graycube {

/// The machine's name, for people.
std::string machine_name();

/// Processes that are told the same may reach each other's local sockets: they run on the same
/// start of the same machine, with the same network and files, as the same user.
std::string locality_tag();

/// Cores that this process may use: those of its affinity, and of its control group's quota.
std::uint32_t usable_cores();

/// Bytes of memory, or of its control group's limit if that is less.
std::uint64_t usable_memory_bytes();

}  // namespace graycube

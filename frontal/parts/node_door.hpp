// Decides whether a process that says hello is one of the farm's own.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "proto/messages.hpp"
#include "transport/secret.hpp"

namespace graycube {

class NodeDoor {
 public:
  /// Without a secret all are let in: those of a simulation.
  explicit NodeDoor(std::optional<Secret> secret) : secret_(secret) {}

  /// Why the hello doesn't count; null if it does. `shown`: what came with it; `folder`: where
  /// nodes of its host listen at local sockets, nothing if the node should have no host.
  const char* problem_of(const control::Hello& hello, std::span<const std::byte> shown,
                         const std::optional<std::string>& folder) const {
    if (!secret_) return nullptr;
    if (!is_same_secret(shown, *secret_)) return "it came without the farm's secret";
    if (!folder) return "no host was asked to run it";
    if (!is_in_folder(hello.endpoint, "ipc://" + *folder + "/"))
      return "it names an inbox outside the farm's folder";
    return nullptr;
  }

 private:
  static bool is_in_folder(std::string_view endpoint, std::string_view folder) {
    if (!endpoint.starts_with(folder)) return false;
    const std::string_view name = endpoint.substr(folder.size());
    return !name.empty() && name.front() != '.' && name.find('/') == name.npos;
  }

  std::optional<Secret> secret_;
};

}  // namespace graycube

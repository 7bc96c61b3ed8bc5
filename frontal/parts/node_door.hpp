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
  /// Without a secret all are let in: those of a simulation. With one, nodes listen at local
  /// sockets in `folder`.
  NodeDoor(std::optional<Secret> secret, std::string folder)
      : secret_(secret), folder_("ipc://" + std::move(folder) + "/") {}

  /// Why the hello doesn't count; null if it does. `shown`: what came with it.
  const char* problem_of(const control::Hello& hello, std::span<const std::byte> shown) const {
    if (!secret_) return nullptr;
    if (!is_same_secret(shown, *secret_)) return "it came without the farm's secret";
    if (!is_in_folder(hello.endpoint)) return "it names an inbox outside the farm's folder";
    return nullptr;
  }

 private:
  bool is_in_folder(std::string_view endpoint) const {
    if (!endpoint.starts_with(folder_)) return false;
    const std::string_view name = endpoint.substr(folder_.size());
    return !name.empty() && name.front() != '.' && name.find('/') == name.npos;
  }

  std::optional<Secret> secret_;
  std::string folder_;
};

}  // namespace graycube

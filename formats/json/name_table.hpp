// Names of materials or shapes and their indices, for look-up while a file is read.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace graycube {

/// The names are views: what they point to must live as long as the table.
class NameTable {
 public:
  /// Adds a name and returns its index; nothing if the name is there already.
  std::optional<std::uint32_t> add(std::string_view name) {
    const auto index = static_cast<std::uint32_t>(names_.size());
    if (!indices_.try_emplace(name, index).second) return std::nullopt;
    names_.push_back(name);
    return index;
  }
  std::optional<std::uint32_t> find(std::string_view name) const {
    const auto found = indices_.find(name);
    if (found == indices_.end()) return std::nullopt;
    return found->second;
  }
  /// The names in the order of their indices.
  const std::vector<std::string_view>& names() const { return names_; }

 private:
  std::unordered_map<std::string_view, std::uint32_t> indices_;
  std::vector<std::string_view> names_;
};

}  // namespace graycube

// The places that a link keeps for rays of each class, whether its credit is out or not (FORMAT.md,
// section 6).
#pragma once

#include <cstdint>
#include <map>

namespace graycube {

class ClassPlaces {
 public:
  /// False when all `most` places of the class are taken.
  [[nodiscard]] bool take(std::uint16_t of_class, std::uint32_t most) {
    std::uint32_t& taken = taken_[of_class];
    if (taken >= most) return false;
    ++taken;
    return true;
  }
  /// False when none is taken.
  [[nodiscard]] bool give_back(std::uint16_t of_class) {
    const auto place = taken_.find(of_class);
    if (place == taken_.end()) return false;
    if (--place->second == 0) taken_.erase(place);
    return true;
  }
  void clear() { taken_.clear(); }

 private:
  std::map<std::uint16_t, std::uint32_t> taken_;
};

}  // namespace graycube

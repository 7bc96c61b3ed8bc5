// A cursor over the big-endian bytes of a binary database.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

#include "geometry/vec.hpp"

namespace graycube {

/// Reads big-endian values; after the first that doesn't fit, everything is 0 and ok() is false.
class BrlcadByteReader {
 public:
  explicit BrlcadByteReader(std::string_view bytes) : bytes_(bytes) {}

  bool ok() const { return ok_; }
  std::size_t remaining() const { return bytes_.size(); }

  std::uint64_t integer(unsigned width) {
    const std::string_view field = take(width);
    std::uint64_t v = 0;
    for (const char c : field) v = v << 8 | static_cast<unsigned char>(c);
    return v;
  }
  double number() { return std::bit_cast<double>(integer(8)); }
  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  std::string_view take(std::uint64_t count) {
    if (count > bytes_.size()) {
      ok_ = false;
      bytes_ = {};
      return {};
    }
    const std::string_view field = bytes_.substr(0, static_cast<std::size_t>(count));
    bytes_.remove_prefix(static_cast<std::size_t>(count));
    return field;
  }
  /// The text up to a zero byte, which is taken too.
  std::string_view text() {
    const std::size_t end = bytes_.find('\0');
    if (end == std::string_view::npos) {
      take(bytes_.size() + 1);
      return {};
    }
    const std::string_view field = take(end);
    take(1);
    return field;
  }

 private:
  std::string_view bytes_;
  bool ok_ = true;
};

/// The number of bytes of a number with this width code.
inline unsigned width_of(unsigned code) { return 1u << (code & 3u); }

}  // namespace graycube

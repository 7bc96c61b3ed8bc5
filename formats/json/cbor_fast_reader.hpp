// Reads CBOR as our writer writes it in one plain loop, and gives up at the first thing that is
// wrong or unusual. A scene can be read without ever holding the whole tree: all but its objects
// first, then these one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "formats/json/tree.hpp"

namespace graycube {

/// Accepts heads with a length, doubles, singles, integers, texts in one piece, arrays, maps, true,
/// false and null. Each function returns false at anything else; the tree then holds anything.
class FastCborReader {
 public:
  /// `tree` must be empty, and its text begin with the magic.
  explicit FastCborReader(JsonTree& tree);

  bool read_whole();
  /// Reads everything up to the elements of the root's last member, which must be an array called
  /// `key`: it gets its size, but no children. read_element() reads the elements.
  bool read_up_to(std::string_view key);
  /// Reads the next element of that array in the place of the one before; `at` becomes its
  /// number.
  bool read_element(JsonIndex& at);
  bool is_at_end() const { return at_ == end_; }

 private:
  /// The first bytes of a value.
  struct Head {
    std::uint8_t major = 0, info = 0;
    std::uint64_t argument = 0;
  };
  struct Level {
    JsonIndex self;
    bool is_map;
    /// Elements or members still to come.
    std::uint64_t left;
  };
  /// The key of an object's member; its begin is 0 when there is none.
  struct Key {
    std::uint32_t begin = 0;
    std::uint16_t length = 0;
  };

  bool read_value(Key key);
  bool read_key(Key& key);
  static bool read_head(const char*& at, const char* end, Head& head);
  static bool skip_text(const char*& at, const char* end, const Head& head);
  static bool scalar_of(const Head& head, JsonKind& kind, std::uint64_t& payload);
  std::uint32_t offset(const char* at) const { return static_cast<std::uint32_t>(at - begin_); }
  JsonIndex add(JsonKind kind, const char* at, std::uint64_t payload, const Key& key);

  JsonTree& tree_;
  const char *begin_, *at_, *end_;
  std::vector<Level> levels_;
  /// Number of containers around the values that are read in pieces.
  std::size_t outer_levels_ = 0;
  std::size_t kept_values_ = 0;
  std::uint64_t dropped_values_ = 0;
};

}  // namespace graycube

// JSON text as a compact tree: 24 bytes a value, strings left in the text, and each value's place
// known. Scenes of a million primitives are read through this one. simdjson reads the text; where
// it finds anything wrong or unusual, nlohmann's parser reads it again, whose word is final. Their
// own documents would take several times the memory, drop duplicate keys or know no places.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graycube {

/// Largest text: offsets are 32-bit.
inline constexpr std::uint64_t kMaxJsonBytes = 0xFFFFFFFFull;
/// The deepest nesting of arrays and objects, and the most bytes of a string.
inline constexpr std::uint32_t kMaxJsonNesting = 1024;
inline constexpr std::uint32_t kMaxJsonString = 65535;

/// CBOR begins with these bytes, the tag that describes itself (RFC 8949, 3.4.6); JSON doesn't.
inline constexpr std::string_view kCborMagic = "\xD9\xD9\xF7";
/// Most values of a text: each takes 24 bytes of memory, 1.3 GB together, and may be as short as
/// two bytes, in CBOR as one. The largest mesh, of 2^23 triangles and half as many points, has
/// 12 << 22.
inline constexpr std::uint32_t kMaxJsonValues = 13u << 22;
/// Most values of CBOR that is read in pieces, of which few are in memory at a time.
inline constexpr std::uint32_t kMaxCborValues = 1u << 27;

enum class JsonKind : std::uint8_t { kNull, kFalse, kTrue, kNumber, kString, kArray, kObject };

/// The number of a value in the order of the text. The root is 0, so 0 is no value's member.
using JsonIndex = std::uint32_t;

/// The place of a character in the text, line and column from 1; columns count bytes.
struct TextPosition {
  std::uint64_t line = 1, column = 1;
};

class PaddedText;

/// Readers ask after so many values whether they are to stop (stop_point.hpp): some milliseconds.
inline constexpr JsonIndex kValuesBetweenStops = JsonIndex{1} << 16;

class JsonTree {
 public:
  struct SyntaxError {
    std::uint64_t offset = 0;
    /// The value that was being read.
    JsonIndex value = 0;
    std::string message;
  };

  /// Reads RFC 8259 JSON (a UTF-8 byte order mark is skipped). `text` must outlive the tree and be
  /// no longer than kMaxJsonBytes. Numbers are rounded to nearest; one beyond the range of a
  /// double counts as a syntax error. Duplicate keys are kept, for the reader to find. After a
  /// syntax error the tree holds what came before.
  /// Without padding behind the text only the careful parser can read it, at a third of the
  /// speed. Both give the same tree and the same errors.
  explicit JsonTree(std::string_view text);
  /// Reads nothing yet: a FastCborReader will. `text` must begin with kCborMagic.
  struct Unread {};
  JsonTree(std::string_view text, Unread) : text_(text), was_read_fast_(true), is_cbor_(true) {}
  explicit JsonTree(const PaddedText& text);

  /// Whether the text was CBOR: maps with keys that are texts, arrays, texts, finite numbers, true,
  /// false and null; no other tags, no byte strings. Offsets are in bytes, lines have no meaning.
  bool is_cbor() const { return is_cbor_; }
  /// False when the careful parser had to read the text.
  bool was_read_fast() const { return was_read_fast_; }

  const std::optional<SyntaxError>& syntax_error() const { return syntax_error_; }

  std::size_t value_count() const { return values_.size(); }
  JsonKind kind(JsonIndex i) const { return values_[i].kind; }
  double number(JsonIndex i) const { return std::bit_cast<double>(values_[i].payload); }
  /// The decoded text; the value must be a string.
  std::string_view string(JsonIndex i) const {
    const Value& v = values_[i];
    return text_or_decoded(v.string_is_decoded, v.payload >> 32, v.payload & 0xFFFFFFFFu);
  }
  /// The decoded key; the value must be an object's member.
  std::string_view key(JsonIndex i) const {
    const Value& v = values_[i];
    return text_or_decoded(v.key_is_decoded, v.key_begin, v.key_length);
  }
  /// The number of elements or members; the value must be an array or an object.
  std::uint32_t size(JsonIndex i) const { return static_cast<std::uint32_t>(values_[i].payload); }
  /// Children of i: first_child(i), then next(child), until end(i).
  JsonIndex first_child(JsonIndex i) const { return i + 1; }
  JsonIndex next(JsonIndex i) const { return values_[i].next; }
  JsonIndex end(JsonIndex i) const { return values_[i].next; }

  std::uint64_t offset(JsonIndex i) const { return values_[i].begin; }
  /// The value's path from the root (RFC 6901). Takes time linear in the siblings on the way.
  std::string pointer(JsonIndex i) const;
  /// A short description for messages: scalars and short vectors as written,
  /// other containers by kind and size.
  std::string describe(JsonIndex i) const;

 private:
  friend class JsonFilling;
  friend class FastJsonReader;
  friend class FastCborReader;

  JsonTree(std::string_view text, const PaddedText* padded);
  /// False for a text that it doesn't accept; the tree then holds anything.
  bool read_fast(const PaddedText& text);
  void read_carefully();
  /// Whether the text has at most kMaxJsonValues values; else that is the syntax error. Counts
  /// without taking memory.
  bool has_few_values();
  void read_cbor();

  struct Value {
    /// Numbers: the bits of the double. Strings: begin << 32 | length. Containers: the number of
    /// children.
    std::uint64_t payload = 0;
    std::uint32_t begin = 0;      // offset in the text
    std::uint32_t next = 0;       // index past the subtree
    std::uint32_t key_begin = 0;  // offset in the text, or index into decoded_
    std::uint16_t key_length = 0;
    JsonKind kind = JsonKind::kNull;
    bool key_is_decoded : 1 = false;
    bool string_is_decoded : 1 = false;
  };
  static_assert(sizeof(Value) == 24);

  std::string_view text_or_decoded(bool decoded, std::size_t begin, std::size_t length) const {
    return decoded ? std::string_view(decoded_[begin])
                   : std::string_view(text_.data() + begin, length);
  }
  std::string describe_array(JsonIndex i) const;
  std::string describe_cbor_array(JsonIndex i) const;

  std::string_view text_;
  std::vector<Value> values_;
  /// Strings that hold escapes, decoded; a deque, so that views of them stay valid.
  std::deque<std::string> decoded_;
  std::optional<SyntaxError> syntax_error_;
  bool was_read_fast_ = false;
  bool is_cbor_ = false;
};

/// Positions of ascending offsets in `text`, in one pass.
std::vector<TextPosition> text_positions(std::string_view text,
                                         const std::vector<std::uint64_t>& offsets);

}  // namespace graycube

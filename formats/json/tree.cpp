#include "formats/json/tree.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "formats/json/padded_text.hpp"
#include "json_pointer.hpp"
#include "spelling.hpp"

namespace graycube {
namespace {

/// Most bytes of an excerpt of the text in a message.
constexpr std::size_t kMaxExcerpt = 40;

/// Scenes have a value every 10 bytes or so; memory reserved in excess is never touched.
constexpr std::size_t kBytesPerValue = 7;
/// In longer texts values are counted first.
constexpr std::size_t kMaxUncountedBytes = std::size_t{1} << 24;
/// simdjson takes 4 bytes more for each token, of which there are two a value: texts of more values
/// are left to the careful parser.
constexpr std::size_t kMaxFastValues = std::size_t{1} << 25;

std::string shortest_text(double v) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, v).ptr};
}

/// At least the number of values of a JSON text: the root, one behind each comma, and one at the
/// begin of each container, which may be empty. Escaped quotes don't end a string.
std::size_t most_values(std::string_view text) {
  std::size_t count = 1;
  bool is_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_string = !is_string;
    if (is_string)
      i += c == '\\';
    else
      count += c == ',' || c == '[' || c == '{';
  }
  return count;
}

}  // namespace

JsonTree::JsonTree(std::string_view text) : JsonTree(text, nullptr) {}

JsonTree::JsonTree(const PaddedText& text) : JsonTree(text.view(), &text) {}

JsonTree::JsonTree(std::string_view text, const PaddedText* padded) : text_(text) {
  is_cbor_ = text.starts_with(kCborMagic);
  if (is_cbor_) {
    read_cbor();
    return;
  }
  if (!has_few_values()) return;
  const bool may_be_fast = padded != nullptr && values_.capacity() <= kMaxFastValues;
  was_read_fast_ = may_be_fast && read_fast(*padded);
  if (was_read_fast_) return;
  values_.clear();
  decoded_.clear();
  read_carefully();
}

bool JsonTree::has_few_values() {
  // Growing by doubling would touch three times the memory, and first touches are half the time.
  std::size_t expected = text_.size() / kBytesPerValue + 1;
  if (text_.size() > kMaxUncountedBytes) {
    expected = most_values(text_);
    if (expected > kMaxJsonValues) {
      values_.emplace_back();
      syntax_error_ = {0, 0,
                       "the text has more than " + std::to_string(kMaxJsonValues) + " values"};
      return false;
    }
  }
  values_.reserve(expected);
  return true;
}

std::string JsonTree::pointer(JsonIndex i) const {
  std::string pointer;
  JsonIndex at = 0;
  while (at != i && at < values_.size()) {
    std::size_t position = 0;
    JsonIndex child = first_child(at);
    for (; next(child) <= i; child = next(child)) ++position;
    append_token(pointer, kind(at) == JsonKind::kObject ? key(child) : std::to_string(position));
    at = child;
  }
  return pointer;
}

std::string JsonTree::describe(JsonIndex i) const {
  switch (kind(i)) {
    case JsonKind::kNull: return "null";
    case JsonKind::kFalse: return "false";
    case JsonKind::kTrue: return "true";
    case JsonKind::kArray: return describe_array(i);
    case JsonKind::kObject: return "an object";
    case JsonKind::kString: {
      std::string_view s = string(i);
      // A cut must not split a UTF-8 sequence.
      std::size_t length = std::min(s.size(), kMaxExcerpt);
      while (length > 0 && length < s.size() &&
             (static_cast<unsigned char>(s[length]) & 0xC0) == 0x80)
        --length;
      std::string text(s.substr(0, length));
      if (length < s.size()) text += "…";
      return quoted(text);
    }
    case JsonKind::kNumber: break;
  }
  if (is_cbor_) return shortest_text(number(i));
  const std::string_view rest = text_.substr(values_[i].begin, kMaxExcerpt);
  return std::string(rest.substr(0, rest.find_first_not_of("+-.eE0123456789")));
}

std::string JsonTree::describe_cbor_array(JsonIndex i) const {
  constexpr std::uint32_t kMaxShown = 4;
  std::string text = "[";
  for (JsonIndex c = first_child(i); c != end(i); c = next(c)) {
    if (kind(c) != JsonKind::kNumber || size(i) > kMaxShown)
      return "an array of " + std::to_string(size(i));
    if (text.size() > 1) text += ',';
    text += shortest_text(number(c));
  }
  return size(i) == 0 ? "an empty array" : text + ']';
}

std::string JsonTree::describe_array(JsonIndex i) const {
  // A short flat array, such as a vector, is shown as written; others by their size.
  if (is_cbor_) return describe_cbor_array(i);
  bool flat = size(i) > 0;
  for (JsonIndex c = first_child(i); flat && c != end(i); c = next(c))
    flat = kind(c) == JsonKind::kNumber && values_[c].begin - values_[i].begin < 2 * kMaxExcerpt;
  const std::string_view rest = text_.substr(values_[i].begin, 2 * kMaxExcerpt);
  const std::size_t close = rest.find(']');
  if (flat && close != std::string_view::npos && rest.find('\n') > close)
    return std::string(rest.substr(0, close + 1));
  return size(i) == 0 ? "an empty array" : "an array of " + std::to_string(size(i));
}

std::vector<TextPosition> text_positions(std::string_view text,
                                         const std::vector<std::uint64_t>& offsets) {
  std::vector<TextPosition> positions;
  positions.reserve(offsets.size());
  std::uint64_t line = 1;
  std::size_t line_begin = 0, searched = 0;
  for (const std::uint64_t offset : offsets) {
    const std::string_view before = text.substr(0, offset);
    for (auto n = before.find('\n', searched); n != std::string_view::npos;
         n = before.find('\n', n + 1)) {
      ++line;
      line_begin = n + 1;
    }
    searched = before.size();
    positions.push_back({line, offset - line_begin + 1});
  }
  return positions;
}

}  // namespace graycube

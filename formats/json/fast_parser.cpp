// Fills a JsonTree by simdjson: the only file that knows the library. It reads usual scenes at
// several times the speed of the careful parser, and gives up at the first thing that is wrong or
// unusual; the careful parser then reads the text again, and words the error.
#include <simdjson.h>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>

#include "formats/json/padded_text.hpp"
#include "formats/json/tree.hpp"
#include "stop_point.hpp"

namespace graycube {
namespace {

namespace ondemand = simdjson::ondemand;

static_assert(kTextPadding >= simdjson::SIMDJSON_PADDING);
/// The careful parser reads longer texts. The library reserves 6 bytes of address space for a byte
/// of text, and touches 4 bytes for a token.
constexpr std::size_t kMaxFastBytes = std::size_t{1} << 30;
/// The library counts one more level for the document, and one for a scalar.
constexpr std::size_t kLibraryLevels = kMaxJsonNesting + 2;

/// simdjson 3.0.1 wraps around in zero point more than 19 digits (0.77870955597254552026672 becomes
/// 0.05), so it only checks the form of longer numbers.
constexpr std::size_t kMaxTrustedNumber = 20;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

/// Each function returns whether all was well. For the library's own calls, `true` is an error.
class FastJsonReader {
 public:
  FastJsonReader(std::string_view text, JsonTree& tree) : text_(text), tree_(tree) {}

  bool read() {
    if (text_.size() > kMaxFastBytes) return false;
    std::string_view json = text_;
    if (json.starts_with(kByteOrderMark)) json.remove_prefix(kByteOrderMark.size());
    ondemand::parser parser;
    if (json.empty() || parser.allocate(json.size(), kLibraryLevels)) return false;
    ondemand::document document;
    ondemand::json_type type{};
    if (parser.iterate(json, json.size() + kTextPadding).get(document)) return false;
    if (document.type().get(type)) return false;
    // Other roots are no scenes, and the library reads them by other functions.
    const std::size_t begin = text_.find_first_of("[{");
    if (type == ondemand::json_type::array) {
      ondemand::array array;
      if (document.get_array().get(array) || !read_array(array, begin, {})) return false;
    } else if (type == ondemand::json_type::object) {
      ondemand::object object;
      if (document.get_object().get(object) || !read_object(object, begin, {})) return false;
    } else {
      return false;
    }
    // There must be nothing behind the root.
    return document.current_location().error() == simdjson::OUT_OF_BOUNDS;
  }

 private:
  /// A string as found: a range of the text, or an index into the tree's decoded strings.
  struct Text {
    std::uint32_t begin = 0;
    std::uint16_t length = 0;
    bool decoded = false;
  };

  std::size_t offset(const char* at) const { return static_cast<std::size_t>(at - text_.data()); }

  JsonTree::Value& add(JsonKind kind, std::size_t begin, const Text& key) {
    const auto self = static_cast<JsonIndex>(tree_.values_.size());
    if (self % kValuesBetweenStops == 0) stop_if_asked();
    JsonTree::Value& value = tree_.values_.emplace_back();
    value.kind = kind;
    value.begin = static_cast<std::uint32_t>(begin);
    value.next = self + 1;
    value.key_begin = key.begin;
    value.key_length = key.length;
    value.key_is_decoded = key.decoded;
    return value;
  }

  JsonIndex open(JsonKind kind, std::size_t begin, const Text& key) {
    ++nesting_;
    add(kind, begin, key);
    return static_cast<JsonIndex>(tree_.values_.size() - 1);
  }

  void close(JsonIndex self, std::uint64_t size) {
    --nesting_;
    tree_.values_[self].payload = size;
    tree_.values_[self].next = static_cast<JsonIndex>(tree_.values_.size());
  }

  bool read_array(ondemand::array& array, std::size_t begin, const Text& key) {
    if (nesting_ >= kMaxJsonNesting) return false;
    const JsonIndex self = open(JsonKind::kArray, begin, key);
    std::uint64_t size = 0;
    for (auto element : array) {
      ondemand::value value;
      if (std::move(element).get(value) || !read_value(value, {})) return false;
      ++size;
    }
    close(self, size);
    return true;
  }

  bool read_object(ondemand::object& object, std::size_t begin, const Text& key) {
    if (nesting_ >= kMaxJsonNesting) return false;
    const JsonIndex self = open(JsonKind::kObject, begin, key);
    std::uint64_t size = 0;
    for (auto member : object) {
      ondemand::field field;
      if (std::move(member).get(field)) return false;
      Text name;
      const auto decode = [&] { return field.unescaped_key(); };
      if (!read_text(field.key().raw(), decode, name)) return false;
      if (!read_value(field.value(), name)) return false;
      ++size;
    }
    close(self, size);
    return true;
  }

  bool read_value(ondemand::value& value, const Text& key) {
    ondemand::json_type type{};
    if (value.type().get(type)) return false;
    const std::size_t begin = offset(value.raw_json_token().data());
    switch (type) {
      case ondemand::json_type::array: {
        ondemand::array array;
        return !value.get_array().get(array) && read_array(array, begin, key);
      }
      case ondemand::json_type::object: {
        ondemand::object object;
        return !value.get_object().get(object) && read_object(object, begin, key);
      }
      case ondemand::json_type::number: return read_number(value, begin, key);
      case ondemand::json_type::string: return read_string(value, begin, key);
      case ondemand::json_type::boolean: {
        bool truth = false;
        if (value.get_bool().get(truth)) return false;
        add(truth ? JsonKind::kTrue : JsonKind::kFalse, begin, key);
        return true;
      }
      case ondemand::json_type::null: {
        bool null = false;
        if (value.is_null().get(null) || !null) return false;
        add(JsonKind::kNull, begin, key);
        return true;
      }
    }
    return false;
  }

  bool read_number(ondemand::value& value, std::size_t begin, const Text& key) {
    std::string_view token = value.raw_json_token();
    double number = 0;
    if (value.get_double().get(number)) return false;
    // The token includes the blanks behind it.
    if (token.size() > kMaxTrustedNumber) token = token.substr(0, token.find_first_of(" \t\n\r"));
    if (token.size() > kMaxTrustedNumber) {
      const auto read = std::from_chars(token.data(), token.data() + token.size(), number);
      if (read.ec != std::errc()) return false;
    }
    add(JsonKind::kNumber, begin, key).payload = std::bit_cast<std::uint64_t>(number);
    return true;
  }

  bool read_string(ondemand::value& value, std::size_t begin, const Text& key) {
    ondemand::raw_json_string raw;
    if (value.get_raw_json_string().get(raw)) return false;
    Text text;
    const auto decode = [&] { return value.get_string(); };
    if (!read_text(raw.raw(), decode, text)) return false;
    JsonTree::Value& added = add(JsonKind::kString, begin, key);
    added.payload = std::uint64_t{text.begin} << 32 | text.length;
    added.string_is_decoded = text.decoded;
    return true;
  }

  /// `raw` is behind the opening quote. The library has checked that the string ends, holds no
  /// control characters and is UTF-8; its escapes are checked when decoded.
  template <typename Decode>
  bool read_text(const char* raw, const Decode& decode, Text& out) {
    std::size_t length = 0;
    while (raw[length] != '"' && raw[length] != '\\' && length <= kMaxJsonString) ++length;
    out.decoded = raw[length] == '\\';
    out.begin = static_cast<std::uint32_t>(out.decoded ? tree_.decoded_.size() : offset(raw));
    if (out.decoded) {
      std::string_view decoded;
      if (decode().get(decoded)) return false;
      length = decoded.size();
      tree_.decoded_.emplace_back(decoded);
    }
    out.length = static_cast<std::uint16_t>(length);
    return length <= kMaxJsonString;
  }

  std::string_view text_;
  JsonTree& tree_;
  std::uint32_t nesting_ = 0;
};

bool JsonTree::read_fast(const PaddedText& text) {
  return FastJsonReader(text.view(), *this).read();
}

}  // namespace graycube

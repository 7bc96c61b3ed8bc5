// Fills a JsonTree from CBOR (RFC 8949) by nlohmann's parser: it decides what is CBOR here, and words what is wrong.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "scene/cbor_fast_reader.hpp"
#include "scene/json_tree.hpp"
#include "scene/tracked_text.hpp"

namespace graycube {
namespace {

using Json = nlohmann::json;

}  // namespace

/// The library calls what has the names of its json_sax.
class CborEvents {
 public:
  CborEvents(std::string_view bytes, JsonTree& tree) : bytes_(bytes), tree_(tree) {}

  void parse() {
    const char* const begin = bytes_.data() + kCborMagic.size();
    reached_ = begin;
    Json::sax_parse(TrackedText(begin, &reached_), TrackedText(bytes_.data() + bytes_.size(), &reached_), this,
                    Json::input_format_t::cbor, true);
    // Also after a failure, so that pointers to what was read stay right.
    while (!open_.empty()) close();
  }

  bool null() { return add(JsonKind::kNull) != nullptr; }
  bool boolean(bool value) { return add(value ? JsonKind::kTrue : JsonKind::kFalse) != nullptr; }
  bool number_integer(Json::number_integer_t value) { return add_number(static_cast<double>(value)); }
  bool number_unsigned(Json::number_unsigned_t value) { return add_number(static_cast<double>(value)); }
  bool number_float(double value, std::string_view) {
    if (!std::isfinite(value)) return fail(offset(), "expected a finite number");
    return add_number(value);
  }
  bool string(std::string_view value) {
    Text text;
    JsonTree::Value* added = keep(value, text) ? add(JsonKind::kString) : nullptr;
    if (added == nullptr) return false;
    added->payload = std::uint64_t{text.begin} << 32 | text.length;
    added->string_is_decoded = text.decoded;
    return true;
  }
  bool key(std::string_view value) { return keep(value, key_); }
  bool start_object(std::size_t) { return open(JsonKind::kObject); }
  bool start_array(std::size_t) { return open(JsonKind::kArray); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool binary(Json::binary_t&) { return fail(offset(), "byte strings are not accepted"); }

  /// `position` counts the bytes read behind the magic, the end as one.
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) {
    std::string_view why = error.what();
    constexpr std::string_view kParsing = "while parsing ";
    const std::size_t parsing = why.find(kParsing);
    if (parsing != std::string_view::npos) why.remove_prefix(parsing + kParsing.size());
    const std::size_t last = kCborMagic.size() + (position > 0 ? position - 1 : 0);
    return fail(std::min(last, bytes_.size()), std::string(why));
  }

 private:
  /// A string as found: a range of the bytes, or an index into the tree's decoded strings.
  struct Text {
    std::uint32_t begin = 0, length = 0;
    bool decoded = false;
  };

  /// Just behind the last byte that the library has read.
  std::size_t offset() const { return static_cast<std::size_t>(reached_ - bytes_.data()); }

  /// Null after a failure.
  JsonTree::Value* add(JsonKind kind) {
    const auto self = static_cast<JsonIndex>(tree_.values_.size());
    if (self == kMaxCborValues) {
      fail(offset(), "more than " + std::to_string(kMaxCborValues) + " values");
      return nullptr;
    }
    if (!open_.empty()) ++tree_.values_[open_.back()].payload;
    JsonTree::Value& value = tree_.values_.emplace_back();
    value.kind = kind;
    value.begin = static_cast<std::uint32_t>(offset());
    value.next = self + 1;
    value.key_begin = key_.begin;
    value.key_length = static_cast<std::uint16_t>(key_.length);
    value.key_is_decoded = key_.decoded;
    key_ = {};
    return &value;
  }

  bool add_number(double number) {
    JsonTree::Value* added = add(JsonKind::kNumber);
    if (added != nullptr) added->payload = std::bit_cast<std::uint64_t>(number);
    return added != nullptr;
  }

  bool open(JsonKind kind) {
    const auto self = static_cast<JsonIndex>(tree_.values_.size());
    if (add(kind) == nullptr) return false;
    if (open_.size() >= kMaxJsonNesting) {
      return fail(offset(), "arrays and maps nest deeper than " + std::to_string(kMaxJsonNesting));
    }
    open_.push_back(self);
    return true;
  }
  bool close() {
    tree_.values_[open_.back()].next = static_cast<JsonIndex>(tree_.values_.size());
    open_.pop_back();
    return true;
  }

  /// A string in one piece stays among the bytes; one in chunks is copied.
  bool keep(std::string_view value, Text& out) {
    if (value.size() > kMaxJsonString) {
      return fail(offset(), "a string is longer than " + std::to_string(kMaxJsonString) + " bytes");
    }
    out.length = static_cast<std::uint32_t>(value.size());
    out.decoded = bytes_.substr(offset() - value.size(), value.size()) != value;
    out.begin = static_cast<std::uint32_t>(out.decoded ? tree_.decoded_.size() : offset() - value.size());
    if (out.decoded) tree_.decoded_.emplace_back(value);
    return true;
  }

  bool fail(std::size_t at, std::string message) {
    const std::size_t count = tree_.values_.size();
    tree_.syntax_error_ = {at, static_cast<JsonIndex>(count == 0 ? 0 : count - 1), std::move(message)};
    return false;
  }

  std::string_view bytes_;
  JsonTree& tree_;
  const char* reached_ = nullptr;
  std::vector<JsonIndex> open_;  // containers around the next value, outermost first
  Text key_;                     // of the next value; empty in an array
};

void JsonTree::read_cbor() {
  // Values take two bytes and more, mostly; what is reserved in excess is never touched.
  constexpr std::size_t kMaxReserved = std::size_t{1} << 26;
  values_.reserve(std::min(text_.size() / 2 + 1, kMaxReserved));
  was_read_fast_ = FastCborReader(*this).read_whole();
  if (was_read_fast_) return;
  values_.clear();
  CborEvents(text_, *this).parse();
}

}  // namespace graycube

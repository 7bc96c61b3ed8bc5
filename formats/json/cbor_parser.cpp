// Fills a JsonTree from CBOR (RFC 8949) by nlohmann's parser, which decides here what is CBOR, and
// puts errors into words.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "formats/json/cbor_fast_reader.hpp"
#include "formats/json/filling.hpp"
#include "formats/json/tracked_text.hpp"

namespace graycube {
namespace {

using Json = nlohmann::json;

}  // namespace

/// The library calls its members by the names of its json_sax.
class CborEvents {
 public:
  CborEvents(std::string_view bytes, JsonTree& tree) : bytes_(bytes), tree_(tree), filling_(tree) {}

  void parse() {
    const char* const begin = bytes_.data() + kCborMagic.size();
    reached_ = begin;
    Json::sax_parse(TrackedText(begin, &reached_),
                    TrackedText(bytes_.data() + bytes_.size(), &reached_), this,
                    Json::input_format_t::cbor, true);
    // Containers are closed after a failure too, so that pointers to what was read stay right.
    filling_.close_all();
  }

  bool null() { return add(JsonKind::kNull); }
  bool boolean(bool value) { return add(value ? JsonKind::kTrue : JsonKind::kFalse); }
  bool number_integer(Json::number_integer_t value) {
    return add_number(static_cast<double>(value));
  }
  bool number_unsigned(Json::number_unsigned_t value) {
    return add_number(static_cast<double>(value));
  }
  bool number_float(double value, std::string_view) {
    if (!std::isfinite(value)) return filling_.fail(offset(), "expected a finite number");
    return add_number(value);
  }
  bool string(std::string_view value) {
    if (!fits(value) || !has_room()) return false;
    filling_.add_string(offset(), kept(value));
    return true;
  }
  bool key(std::string_view value) {
    if (!fits(value)) return false;
    filling_.set_key(kept(value));
    return true;
  }
  bool start_object(std::size_t) { return open(JsonKind::kObject); }
  bool start_array(std::size_t) { return open(JsonKind::kArray); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool binary(Json::binary_t&) { return filling_.fail(offset(), "byte strings are not accepted"); }

  /// `position` counts the bytes read behind the magic, and the end as one more.
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) {
    std::string_view why = error.what();
    constexpr std::string_view kParsing = "while parsing ";
    const std::size_t parsing = why.find(kParsing);
    if (parsing != std::string_view::npos) why.remove_prefix(parsing + kParsing.size());
    const std::size_t last = kCborMagic.size() + (position > 0 ? position - 1 : 0);
    return filling_.fail(std::min(last, bytes_.size()), std::string(why));
  }

 private:
  /// The offset just behind the last byte that the library has read.
  std::size_t offset() const { return static_cast<std::size_t>(reached_ - bytes_.data()); }

  bool has_room() {
    return tree_.value_count() < kMaxJsonValues ||
           filling_.fail(offset(), "more than " + std::to_string(kMaxJsonValues) + " values");
  }
  bool add(JsonKind kind) {
    if (!has_room()) return false;
    filling_.add(kind, offset());
    return true;
  }
  bool add_number(double number) {
    if (!has_room()) return false;
    filling_.add_number(offset(), number);
    return true;
  }

  bool open(JsonKind kind) {
    if (!has_room()) return false;
    return filling_.open(kind, offset()) ||
           filling_.fail(offset(),
                         "arrays and maps nest deeper than " + std::to_string(kMaxJsonNesting));
  }
  bool close() {
    filling_.close();
    return true;
  }

  bool fits(std::string_view value) {
    return value.size() <= kMaxJsonString ||
           filling_.fail(offset(),
                         "a string is longer than " + std::to_string(kMaxJsonString) + " bytes");
  }
  /// A string in one piece stays among the bytes; one in chunks is copied.
  JsonFilling::Text kept(std::string_view value) {
    const std::size_t begin = offset() - value.size();
    return filling_.keep(value, bytes_.substr(begin, value.size()) == value, begin);
  }

  std::string_view bytes_;
  const JsonTree& tree_;
  JsonFilling filling_;
  const char* reached_ = nullptr;
};

void JsonTree::read_cbor() {
  // Values mostly take two bytes or more; memory reserved in excess is never touched.
  values_.reserve(std::min<std::size_t>(text_.size() / 2 + 1, kMaxJsonValues));
  was_read_fast_ = FastCborReader(*this).read_whole();
  if (was_read_fast_) return;
  values_.clear();
  CborEvents(text_, *this).parse();
}

}  // namespace graycube

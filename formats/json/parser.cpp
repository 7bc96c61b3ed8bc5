// Fills a JsonTree from the events of nlohmann's parser, which decides here what is JSON, and puts
// errors into words.
#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "formats/json/filling.hpp"
#include "formats/json/tracked_text.hpp"

namespace graycube {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
/// The library's error number for a number too large for a double.
constexpr int kNumberOverflow = 406;

/// What the library says it was parsing there, and what would have been right there, in our words.
struct Expectation {
  std::string_view context, expected;
};
constexpr std::string_view kValueContext = "value";
constexpr std::array<Expectation, 5> kExpectations{{{kValueContext, "a value"},
                                                    {"object key", "a key in double quotes"},
                                                    {"object separator", "':' after the key"},
                                                    {"array", "',' or ']'"},
                                                    {"object", "',' or '}'"}}};

/// The two parts of "[json.exception…] … while parsing CONTEXT - REASON; last read: …".
struct Complaint {
  explicit Complaint(std::string_view what) {
    constexpr std::string_view kParsing = "while parsing ", kDash = " - ";
    const std::size_t parsing = what.find(kParsing), dash = what.find(kDash);
    if (dash == std::string_view::npos) {
      reason = what;
      // From version 3.11.3 on, the library words the error of an empty text differently.
      if (what.find("attempting to parse an empty input") != std::string_view::npos) {
        context = kValueContext;
        reason = "unexpected end of input";
      }
      return;
    }
    if (parsing < dash) context = what.substr(0, dash).substr(parsing + kParsing.size());
    reason = what.substr(dash + kDash.size());
    reason = reason.substr(0, reason.find("; last read: "));
  }
  /// Whether a token doesn't belong there or is none, rather than being wrong inside.
  bool is_about_token() const {
    return reason.starts_with("unexpected ") || reason == "invalid literal";
  }

  std::string_view context, reason;
};

}  // namespace

/// The library calls its members by the names of its json_sax.
class JsonEvents {
 public:
  JsonEvents(std::string_view text, JsonTree& tree) : text_(text), tree_(tree), filling_(tree) {}

  void parse() {
    if (text_.starts_with(kByteOrderMark)) last_end_ = kByteOrderMark.size();
    const char* const end = text_.data() + text_.size();
    const bool good =
        Json::sax_parse(TrackedText(text_.data(), &reached_), TrackedText(end, &reached_), this);
    // The library takes a zero byte for the end of the text.
    if (good && next_token() < text_.size())
      filling_.fail(next_token(), "expected the end of the text, found " + found(next_token()));
    // Containers are closed after a failure too, so that pointers to what was read stay right.
    filling_.close_all();
  }

  bool null() { return add_word(JsonKind::kNull); }
  bool boolean(bool value) { return add_word(value ? JsonKind::kTrue : JsonKind::kFalse); }
  /// Only negative numbers and zero written "-0" come here.
  bool number_integer(Json::number_integer_t value) {
    return add_number(value == 0 ? -0.0 : static_cast<double>(value));
  }
  bool number_unsigned(Json::number_unsigned_t value) {
    return add_number(static_cast<double>(value));
  }
  bool number_float(double value, std::string_view) { return add_number(value); }

  bool string(std::string_view value) {
    if (!fits(value)) return false;
    filling_.add_string(next_token(), kept(value));
    last_end_ = read_so_far();
    return true;
  }

  bool key(std::string_view value) {
    if (!fits(value)) return false;
    filling_.set_key(kept(value));
    last_end_ = read_so_far();
    return true;
  }

  bool start_object(std::size_t) { return open(JsonKind::kObject); }
  bool start_array(std::size_t) { return open(JsonKind::kArray); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  /// Never called for JSON text, which has no binary values.
  bool binary(Json::binary_t&) { return false; }

  /// `position` counts the bytes read, the end of the text as one.
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) {
    if (error.id == kNumberOverflow) {
      const auto self = static_cast<JsonIndex>(tree_.value_count());
      const std::size_t begin = next_token();
      filling_.add(JsonKind::kNumber, begin);
      return filling_.fail(begin, "expected a finite number, found " + tree_.describe(self));
    }
    const std::size_t last_read = std::min(position - 1, text_.size());
    const std::size_t token = std::min(next_token(), last_read);
    if (!filling_.has_open() && tree_.value_count() > 0)
      return filling_.fail(token, "expected the end of the text, found " + found(token));
    const Complaint complaint(error.what());
    if (complaint.context == kValueContext) filling_.add(JsonKind::kNull, next_token());
    const auto known =
        std::find_if(kExpectations.begin(), kExpectations.end(),
                     [&](const Expectation& e) { return e.context == complaint.context; });
    if (!complaint.is_about_token() || known == kExpectations.end())
      return filling_.fail(last_read, std::string(complaint.reason));
    return filling_.fail(token,
                         "expected " + std::string(known->expected) + ", found " + found(token));
  }

 private:
  static bool is_between_tokens(char c) {
    return c == ' ' || c == ',' || c == ':' || c == '\n' || c == '\r' || c == '\t';
  }

  /// Offset just behind the last byte that the library has read.
  std::size_t read_so_far() const { return static_cast<std::size_t>(reached_ - text_.data()); }

  /// The offset of the token that follows the last event. A separator that doesn't belong there is
  /// skipped as well.
  std::size_t next_token() const {
    std::size_t at = last_end_;
    while (at < text_.size() && is_between_tokens(text_[at])) ++at;
    return at;
  }

  bool add_word(JsonKind kind) {
    filling_.add(kind, next_token());
    last_end_ = read_so_far();
    return true;
  }

  bool add_number(double number) {
    filling_.add_number(next_token(), number);
    // The library has read one byte too many, unless the number ends the text.
    const std::size_t read = read_so_far();
    const char last = text_[read - 1];
    last_end_ = last >= '0' && last <= '9' ? read : read - 1;
    return true;
  }

  bool open(JsonKind kind) {
    const std::size_t begin = next_token();
    if (!filling_.open(kind, begin))
      return filling_.fail(
          begin, "arrays and objects nest deeper than " + std::to_string(kMaxJsonNesting));
    last_end_ = read_so_far();
    return true;
  }

  bool close() {
    filling_.close();
    last_end_ = read_so_far();
    return true;
  }

  bool fits(std::string_view decoded) {
    return decoded.size() <= kMaxJsonString ||
           filling_.fail(next_token(),
                         "a string is longer than " + std::to_string(kMaxJsonString) + " bytes");
  }
  /// A string without escapes stays in the text; it is as long decoded as written.
  JsonFilling::Text kept(std::string_view decoded) {
    const std::size_t begin = next_token() + 1, length = read_so_far() - 1 - begin;
    return filling_.keep(decoded, decoded.size() == length, begin);
  }

  /// The token or text at the offset, described for messages.
  std::string found(std::size_t offset) const {
    if (offset >= text_.size()) return "the end of the text";
    const auto c = static_cast<unsigned char>(text_[offset]);
    if (c > 0x20 && c < 0x7F) return std::string("'") + static_cast<char>(c) + "'";
    constexpr std::string_view kHex = "0123456789abcdef";
    return std::string("byte 0x") + kHex[c >> 4] + kHex[c & 15];
  }

  std::string_view text_;
  const JsonTree& tree_;
  JsonFilling filling_;
  const char* reached_ = text_.data();
  std::size_t last_end_ = 0;  // of the last event's token
};

void JsonTree::read_carefully() { JsonEvents(text_, *this).parse(); }

}  // namespace graycube

#include "scene/json_parser.hpp"

#include <bit>
#include <charconv>
#include <system_error>
#include <utility>

#include "scene/json_number.hpp"

namespace graycube {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

void append_utf8(std::string& out, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { out.push_back(static_cast<char>(byte)); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | code >> 6);
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | code >> 12);
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | code >> 18);
    put(0x80 | (code >> 12 & 0x3F));
    put(0x80 | (code >> 6 & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

}  // namespace

JsonParser::JsonParser(std::string_view text, JsonTree& tree) : text_(text), tree_(tree) {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
}

void JsonParser::parse() {
  if (!parse_value(0)) return;
  skip_space();
  if (at_ < text_.size()) fail("expected the end of the text, found " + found());
}

bool JsonParser::fail(std::string message) {
  // The first failure is the one to tell; callers only unwind.
  if (!tree_.syntax_error_) {
    const auto last = tree_.values_.empty() ? 0 : tree_.values_.size() - 1;
    tree_.syntax_error_ = {at_, static_cast<JsonIndex>(last), std::move(message)};
  }
  return false;
}

std::string JsonParser::found() const {
  if (at_ >= text_.size()) return "the end of the text";
  const auto c = static_cast<unsigned char>(text_[at_]);
  if (c > 0x20 && c < 0x7F) return std::string("'") + static_cast<char>(c) + "'";
  constexpr std::string_view kHex = "0123456789abcdef";
  return std::string("byte 0x") + kHex[c >> 4] + kHex[c & 15];
}

void JsonParser::skip_space() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (c != ' ' && c != '\n' && c != '\t' && c != '\r') return;
    ++at_;
  }
}

bool JsonParser::parse_value(std::uint32_t nesting) {
  skip_space();
  const auto self = static_cast<JsonIndex>(tree_.values_.size());
  auto& value = tree_.values_.emplace_back();
  value.begin = static_cast<std::uint32_t>(at_);
  value.next = self + 1;
  switch (peek()) {
    case '{': return parse_container(self, true, nesting);
    case '[': return parse_container(self, false, nesting);
    case '"': {
      Text text;
      if (!parse_string(text)) return false;
      value.kind = JsonKind::kString;
      value.payload = std::uint64_t{text.begin} << 32 | text.length;
      value.string_is_decoded = text.decoded;
      return true;
    }
    case 't': return parse_word(self, "true", JsonKind::kTrue);
    case 'f': return parse_word(self, "false", JsonKind::kFalse);
    case 'n': return parse_word(self, "null", JsonKind::kNull);
    default: return parse_number(self);
  }
}

bool JsonParser::parse_word(JsonIndex self, std::string_view word, JsonKind kind) {
  if (text_.substr(at_, word.size()) != word) return fail("expected a value, found " + found());
  at_ += word.size();
  tree_.values_[self].kind = kind;
  return true;
}

bool JsonParser::parse_container(JsonIndex self, bool object, std::uint32_t nesting) {
  tree_.values_[self].kind = object ? JsonKind::kObject : JsonKind::kArray;
  if (nesting >= kMaxJsonNesting)
    return fail("arrays and objects nest deeper than " + std::to_string(kMaxJsonNesting));
  const char close = object ? '}' : ']';
  ++at_;
  skip_space();
  if (peek() == close) {
    ++at_;
    return true;
  }
  std::uint64_t count = 0;
  bool good = false;
  while (object ? parse_member(nesting + 1) : parse_value(nesting + 1)) {
    ++count;
    skip_space();
    if (peek() == ',') {
      ++at_;
      continue;
    }
    good = peek() == close;
    if (!good) fail(std::string("expected ',' or '") + close + "', found " + found());
    break;
  }
  // Also when unwinding, so that pointers to what was read stay right.
  tree_.values_[self].payload = count;
  tree_.values_[self].next = static_cast<JsonIndex>(tree_.values_.size());
  at_ += good ? 1 : 0;
  return good;
}

bool JsonParser::parse_member(std::uint32_t nesting) {
  skip_space();
  if (peek() != '"') return fail("expected a key in double quotes, found " + found());
  Text key;
  if (!parse_string(key)) return false;
  skip_space();
  if (peek() != ':') return fail("expected ':' after the key, found " + found());
  ++at_;
  const std::size_t member = tree_.values_.size();
  const bool good = parse_value(nesting);
  auto& value = tree_.values_[member];
  value.key_begin = key.begin;
  value.key_length = static_cast<std::uint16_t>(key.length);
  value.key_is_decoded = key.decoded;
  return good;
}

bool JsonParser::parse_string(Text& out) {
  const std::size_t begin = ++at_;
  for (;;) {
    const auto c = static_cast<unsigned char>(peek());
    if (c == '"') break;
    if (c == '\\') return decode_string(begin, out);
    if (c >= 0x80) {
      if (!skip_utf8()) return false;
      continue;
    }
    if (c < 0x20) {
      if (at_ >= text_.size()) return fail("the text ends inside a string");
      return fail("a string holds the control character " + found());
    }
    ++at_;
  }
  if (at_ - begin > kMaxJsonString)
    return fail("a string is longer than " + std::to_string(kMaxJsonString) + " bytes");
  out = {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at_ - begin), false};
  ++at_;
  return true;
}

bool JsonParser::decode_string(std::size_t begin, Text& out) {
  std::string decoded(text_.substr(begin, at_ - begin));
  for (;;) {
    if (decoded.size() > kMaxJsonString)
      return fail("a string is longer than " + std::to_string(kMaxJsonString) + " bytes");
    const auto c = static_cast<unsigned char>(peek());
    if (c == '"') break;
    if (c == '\\') {
      if (!decode_escape(decoded)) return false;
      continue;
    }
    if (c < 0x20) {
      if (at_ >= text_.size()) return fail("the text ends inside a string");
      return fail("a string holds the control character " + found());
    }
    const std::size_t from = at_;
    if (c >= 0x80 ? !skip_utf8() : (++at_, false)) return false;
    decoded.append(text_.substr(from, at_ - from));
  }
  ++at_;
  out = {static_cast<std::uint32_t>(tree_.decoded_.size()),
         static_cast<std::uint32_t>(decoded.size()), true};
  tree_.decoded_.push_back(std::move(decoded));
  return true;
}

bool JsonParser::decode_escape(std::string& out) {
  ++at_;
  constexpr std::string_view kLetters = "\"\\/bfnrt";
  constexpr std::string_view kMeanings = "\"\\/\b\f\n\r\t";
  const char letter = peek();
  if (letter == 'u') {
    ++at_;
    std::uint32_t code = 0;
    if (!read_hex4(code)) return false;
    if (code >= 0xDC00 && code < 0xE000)
      return fail("a low surrogate without a high one before it");
    if (code >= 0xD800 && code < 0xDC00) {
      std::uint32_t low = 0;
      if (text_.substr(at_, 2) != "\\u") return fail("a high surrogate without a low one after it");
      at_ += 2;
      if (!read_hex4(low)) return false;
      if (low < 0xDC00 || low >= 0xE000) return fail("a high surrogate without a low one after it");
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    }
    append_utf8(out, code);
    return true;
  }
  const std::size_t which = at_ < text_.size() ? kLetters.find(letter) : std::string_view::npos;
  if (which == std::string_view::npos) return fail("unknown escape: backslash and " + found());
  out.push_back(kMeanings[which]);
  ++at_;
  return true;
}

bool JsonParser::read_hex4(std::uint32_t& out) {
  const std::string_view digits = text_.substr(at_, 4);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out, 16);
  if (digits.size() < 4 || error != std::errc{} || end != digits.data() + 4)
    return fail("expected four hexadecimal digits after \\u");
  at_ += 4;
  return true;
}

bool JsonParser::skip_utf8() {
  const auto byte = [&](std::size_t i) {
    return at_ + i < text_.size() ? static_cast<unsigned char>(text_[at_ + i]) : 0u;
  };
  const unsigned first = byte(0);
  // The second byte's range excludes overlong forms, surrogates and what lies beyond U+10FFFF.
  unsigned low = 0x80, high = 0xBF;
  std::size_t length = 0;
  if (first >= 0xC2 && first <= 0xDF) length = 2;
  if (first >= 0xE0 && first <= 0xEF) length = 3;
  if (first >= 0xF0 && first <= 0xF4) length = 4;
  if (first == 0xE0) low = 0xA0;
  if (first == 0xED) high = 0x9F;
  if (first == 0xF0) low = 0x90;
  if (first == 0xF4) high = 0x8F;
  bool good = length != 0 && byte(1) >= low && byte(1) <= high;
  for (std::size_t i = 2; i < length; ++i) good = good && byte(i) >= 0x80 && byte(i) <= 0xBF;
  if (!good) return fail("a string holds bytes that are not UTF-8: " + found());
  at_ += length;
  return true;
}

bool JsonParser::parse_number(JsonIndex self) {
  const std::size_t begin = at_;
  JsonDecimal decimal;
  if (peek() == '-') ++at_;
  if (!is_digit(peek())) {
    if (at_ > begin) return fail("expected a digit after '-', found " + found());
    return fail("expected a value, found " + found());
  }
  if (peek() == '0' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))
    return fail("a number must not begin with a zero and a digit");
  at_ = decimal.take(text_, at_);
  if (peek() == '.') {
    ++at_;
    if (!is_digit(peek())) return fail("expected a digit after '.', found " + found());
    const std::size_t point = at_;
    at_ = decimal.take(text_, at_);
    decimal.end_fraction(at_ - point);
  }
  if (peek() == 'e' || peek() == 'E') {
    decimal.expect_exponent();
    ++at_;
    if (peek() == '+' || peek() == '-') ++at_;
    if (!is_digit(peek())) return fail("expected a digit of the exponent, found " + found());
    while (is_digit(peek())) ++at_;
  }
  const double result = decimal.value(text_.substr(begin, at_ - begin));
  tree_.values_[self].kind = JsonKind::kNumber;
  tree_.values_[self].payload = std::bit_cast<std::uint64_t>(result);
  return true;
}

}  // namespace graycube

#include "formats/openscad/language/lexer.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

namespace graycube {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";
constexpr std::string_view kSymbols = "(){}[],;=-%#!*";

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}
bool is_name(char c) { return is_name_start(c) || is_digit(c); }

std::string described(char c) {
  if (c > ' ' && c < 127) return std::string("'") + c + "'";
  constexpr std::string_view kHex = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return std::string("byte 0x") + kHex[byte >> 4] + kHex[byte & 15];
}

/// Whether a text can stand behind a string: the end of a list, or a comma with a value or an
/// argument after it.
bool can_follow_string(std::string_view text) {
  const auto skip = [&](std::string_view what) {
    text.remove_prefix(std::min(text.find_first_not_of(what), text.size()));
  };
  skip(kBlanks);
  if (text.empty() || text.front() == ')' || text.front() == ']') return true;
  if (text.front() != ',') return false;
  text.remove_prefix(1);
  skip(kBlanks);
  if (text.empty() || !is_name_start(text.front())) return true;
  const std::string_view all = text;
  while (!text.empty() && is_name(text.front())) text.remove_prefix(1);
  const std::string_view name = all.substr(0, all.size() - text.size());
  if (name == "true" || name == "false" || name == "undef") return true;
  skip(kBlanks);
  return text.starts_with('=');
}

}  // namespace

void ScadLexer::advance_to(std::size_t position) {
  line_ +=
      static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(position_),
                                  text_.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
  position_ = position;
}

/// Skips blanks and comments; false, with a bad token, when a comment has no end.
bool ScadLexer::skip_blanks(ScadToken& token) {
  while (true) {
    advance_to(std::min(text_.find_first_not_of(kBlanks, position_), text_.size()));
    const std::string_view rest = text_.substr(position_);
    if (rest.starts_with("//")) {
      advance_to(std::min(text_.find('\n', position_), text_.size()));
    } else if (rest.starts_with("/*")) {
      const std::size_t end = text_.find("*/", position_ + 2);
      if (end == std::string_view::npos) {
        token = bad("this comment has no end");
        advance_to(text_.size());
        return false;
      }
      advance_to(end + 2);
    } else {
      return true;
    }
  }
}

ScadToken ScadLexer::bad(std::string message) {
  ScadToken token;
  token.kind = ScadToken::Kind::kBad;
  token.line = line_;
  trouble_ = std::move(message);
  return token;
}

ScadToken ScadLexer::next() {
  ScadToken token;
  if (!skip_blanks(token)) return token;
  token.line = line_;
  if (position_ == text_.size()) return token;
  const char c = text_[position_];
  if (is_digit(c) || c == '.') return number();
  if (c == '"') return string();
  if (is_name_start(c)) {
    std::size_t end = position_ + 1;
    while (end < text_.size() && is_name(text_[end])) ++end;
    token.kind = ScadToken::Kind::kIdentifier;
    token.text = text_.substr(position_, end - position_);
    position_ = end;
    return token;
  }
  if (kSymbols.find(c) == std::string_view::npos) {
    token = bad("unexpected " + described(c));
    ++position_;
    return token;
  }
  token.kind = ScadToken::Kind::kSymbol;
  token.text = text_.substr(position_, 1);
  ++position_;
  return token;
}

ScadToken ScadLexer::number() {
  ScadToken token;
  token.kind = ScadToken::Kind::kNumber;
  token.line = line_;
  const char* begin = text_.data() + position_;
  const char* end = text_.data() + text_.size();
  auto [stop, error] = std::from_chars(begin, end, token.number);
  if (error == std::errc::result_out_of_range) token = bad("this number is out of range");
  if (error == std::errc::invalid_argument) {
    token = bad("unexpected '.'");
    ++stop;
  }
  if (error == std::errc{} && stop != end && (is_name(*stop) || *stop == '.')) {
    token = bad("this number is followed by " + described(*stop));
    while (stop != end && (is_name(*stop) || *stop == '.')) ++stop;
  }
  position_ += static_cast<std::size_t>(stop - begin);
  return token;
}

/// OpenSCAD writes strings as they are, quotes and line ends included, without escapes. So a string
/// ends at the first quote before something that can follow a string.
ScadToken ScadLexer::string() {
  ScadToken token;
  token.kind = ScadToken::Kind::kString;
  token.line = line_;
  const std::size_t begin = position_ + 1;
  for (std::size_t quote = text_.find('"', begin); quote != std::string_view::npos;
       quote = text_.find('"', quote + 1)) {
    if (!can_follow_string(text_.substr(quote + 1))) continue;
    token.text = text_.substr(begin, quote - begin);
    advance_to(quote + 1);
    return token;
  }
  token = bad("this string has no end");
  advance_to(text_.size());
  return token;
}

}  // namespace graycube

#include "formats/mesh/words.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "spelling.hpp"

namespace graycube {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
/// Longer words are cut off in messages.
constexpr std::size_t kMaxQuoted = 24;

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0' || c == '\x1A'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Whether a decimal number that no double can hold is too small rather than too large.
bool is_tiny(std::string_view number) {
  const std::size_t exponent = number.find_first_of("eE");
  if (exponent != std::string_view::npos) return number.substr(exponent + 1).starts_with('-');
  if (number.starts_with('-')) number.remove_prefix(1);
  return number.starts_with('0') || number.starts_with('.');
}

}  // namespace

bool equal_words(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

std::string problem_of_encoding(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    return "is text in UTF-16; save it as UTF-8 or ASCII";
  if (bytes.starts_with("\x1F\x8B")) return "is compressed by gzip; unpack it first";
  if (bytes.starts_with("PK\x03\x04")) return "is a ZIP archive; unpack it first";
  return {};
}

Words::Words(std::string_view text, char comment)
    : text_(text), comment_(comment), at_(text.starts_with(kByteOrderMark) ? 3 : 0) {}

std::string_view Words::next() {
  skip();
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_space(text_[at_]) &&
         (comment_ == '\0' || text_[at_] != comment_))
    ++at_;
  return last_ = text_.substr(begin, at_ - begin);
}

void Words::skip_line() {
  while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r') ++at_;
}

std::string_view Words::text_up_to(const Words& later) const {
  std::size_t begin = at_, end = later.at_;
  while (begin < end && is_space(text_[begin])) ++begin;
  while (end > begin && is_space(text_[end - 1])) --end;
  return text_.substr(begin, end - begin);
}

bool Words::at_line_end() {
  while (at_ < text_.size() && text_[at_] != '\n' && text_[at_] != '\r' && is_space(text_[at_]))
    ++at_;
  return at_ == text_.size() || text_[at_] == '\n' || text_[at_] == '\r' ||
         (comment_ != '\0' && text_[at_] == comment_);
}

bool Words::read(double& out) {
  std::string_view word = next();
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
  if (end != word.data() + word.size() || word.empty()) return false;
  if (error == std::errc::result_out_of_range && is_tiny(word)) {
    out = 0;
    return true;
  }
  if (error != std::errc{}) return false;
  digits_.see(word, out);
  return true;
}

bool Words::read(std::uint32_t& out) {
  const std::string_view word = next();
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
  return error == std::errc{} && end == word.data() + word.size() && !word.empty();
}

MeshFault Words::expected(const std::string& what) const {
  if (last_.empty()) return fault("expected " + what + ", found the end of the file");
  std::string word(last_.substr(0, kMaxQuoted));
  for (char& c : word) c = c > ' ' && c <= '~' ? c : '?';
  if (last_.size() > kMaxQuoted) word += "...";
  return fault("expected " + what + ", found " + quoted(word));
}

void Words::skip() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (comment_ != '\0' && c == comment_) {
      skip_line();
    } else if (is_space(c)) {
      if (ends_line(at_)) ++line_;
      ++at_;
    } else {
      return;
    }
  }
}

bool Words::ends_line(std::size_t at) const {
  return text_[at] == '\n' || (text_[at] == '\r' && !text_.substr(at + 1).starts_with('\n'));
}

}  // namespace graycube

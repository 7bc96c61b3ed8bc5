#include "formats/brlcad/database/words.hpp"

#include <charconv>
#include <cmath>

namespace graycube {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

template <typename Number>
std::optional<Number> parse_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  // A number too small for a double is as good as zero.
  if (error == std::errc::result_out_of_range && word.find("e-") != std::string_view::npos) {
    return Number{};
  }
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

void TclWords::take() {
  if (text_[at_] == '\n') ++line_;
  ++at_;
}

void TclWords::skip_blanks() {
  while (!at_end()) {
    const char c = text_[at_];
    const bool is_continued =
        c == '\\' && at_ + 1 < text_.size() && (text_[at_ + 1] == '\n' || text_[at_ + 1] == '\r');
    if (is_continued) {
      take();
      take();
    } else if (is_blank(c) || c == '\0' || (ends_ != Ends::kAtLine && c == '\n')) {
      take();
    } else {
      return;
    }
  }
}

bool TclWords::next_line() {
  std::string word;
  while (is_on_line_ && next(word)) continue;
  is_on_line_ = false;
  if (is_broken_) return false;
  for (;;) {
    skip_blanks();
    if (at_end()) return false;
    if (text_[at_] == '#') {
      while (!at_end() && text_[at_] != '\n') take();
    } else if (text_[at_] == '\n' || text_[at_] == ';') {
      take();
    } else {
      return is_on_line_ = true;
    }
  }
}

bool TclWords::braced(std::string& word) {
  take();
  const std::size_t from = at_;
  for (std::size_t depth = 1; !at_end(); take()) {
    const char c = text_[at_];
    if (c == '\\' && at_ + 1 < text_.size()) {
      take();
    } else if (c == '{') {
      ++depth;
    } else if (c == '}' && --depth == 0) {
      word.assign(text_.substr(from, at_ - from));
      take();
      return true;
    }
  }
  is_broken_ = true;
  return false;
}

bool TclWords::quoted(std::string& word) {
  take();
  word.clear();
  for (; !at_end(); take()) {
    if (text_[at_] == '"') {
      take();
      return true;
    }
    if (text_[at_] == '\\' && at_ + 1 < text_.size()) take();
    word += text_[at_];
  }
  is_broken_ = true;
  return false;
}

bool TclWords::next(std::string& word) {
  skip_blanks();
  if (at_end() || is_broken_) return false;
  const char first = text_[at_];
  const bool is_script = ends_ == Ends::kAtLine;
  if (is_script && (first == '\n' || first == ';')) return false;
  if (first == '}' && ends_ == Ends::kAtBrace) return false;
  if (first == '{') return braced(word);
  if (first == '"') return quoted(word);
  word.clear();
  std::size_t braces = 0;
  for (; !at_end(); take()) {
    const char c = text_[at_];
    if (is_blank(c) || c == '\n' || c == '\0' || (is_script && c == ';')) break;
    if (c == '{') ++braces;
    if (c == '}' && ends_ == Ends::kAtBrace && braces-- == 0) break;
    if (c == '\\' && at_ + 1 < text_.size()) {
      if (text_[at_ + 1] == '\n' || text_[at_ + 1] == '\r') break;
      take();
    }
    word += text_[at_];
  }
  return true;
}

bool TclWords::take_brace(char brace) {
  skip_blanks();
  if (at_end() || text_[at_] != brace) return false;
  take();
  return true;
}

bool TclWords::at_end_of_list() {
  skip_blanks();
  return at_end();
}

std::optional<double> parse_brlcad_number(std::string_view word) {
  const auto value = parse_number<double>(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}
std::optional<long> parse_brlcad_integer(std::string_view word) { return parse_number<long>(word); }

bool append_brlcad_numbers(std::string_view list, std::size_t count, std::vector<double>& out) {
  TclWords words(list);
  for (std::string word; words.next(word); --count) {
    const auto v = parse_brlcad_number(word);
    if (!v || count == 0) return false;
    out.push_back(*v);
  }
  return count == 0 && !words.is_broken();
}

std::vector<std::string_view> blank_separated(std::string_view line, std::size_t most) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; words.size() < most;) {
    while (at < line.size() && is_blank(line[at])) ++at;
    const std::size_t from = at;
    while (at < line.size() && !is_blank(line[at])) ++at;
    if (from == at) break;
    words.push_back(line.substr(from, at - from));
  }
  return words;
}

}  // namespace graycube

// The words of a mesh file's text, with the line that each is on.
#pragma once

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

#include "mesh/close_mesh.hpp"
#include "written_digits.hpp"

namespace graycube {

inline bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
inline char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
inline bool equal_words(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) { return lower(x) == lower(y); });
}

/// Cuts a text into words, and counts lines.
class Words {
 public:
  explicit Words(std::string_view text, char comment = '\0') : text_(text), comment_(comment) {}

  /// The next word; empty at the end.
  std::string_view next() {
    skip();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_]) &&
           (comment_ == '\0' || text_[at_] != comment_))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }
  void skip_line() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  /// Whether the rest of this line holds no word.
  bool at_line_end() {
    while (at_ < text_.size() && text_[at_] != '\n' && is_space(text_[at_])) ++at_;
    return at_ == text_.size() || text_[at_] == '\n' || text_[at_] == comment_;
  }
  bool read(double& out) {
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    if (error != std::errc{} || end != word.data() + word.size() || word.empty()) return false;
    digits_.see(word, out);
    return true;
  }
  bool read(std::uint32_t& out) {
    const std::string_view word = next();
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    return error == std::errc{} && end == word.data() + word.size() && !word.empty();
  }
  MeshFault fault(const std::string& why) const {
    return {"line " + std::to_string(line_) + ": " + why};
  }
  std::size_t left() const { return text_.size() - at_; }
  /// The most significant digits that any double read so far was written with.
  std::uint32_t digits() const { return digits_.most(); }

 private:
  void skip() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (comment_ != '\0' && c == comment_) {
        skip_line();
      } else if (is_space(c)) {
        if (c == '\n') ++line_;
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  char comment_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
  WrittenDigits digits_;
};

}  // namespace graycube

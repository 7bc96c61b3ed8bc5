// The lines of BRL-CAD's text of version 4: a record's first word is one letter; some records go on
// in rows below, each with or without a letter of its own.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

namespace graycube {

class BrlcadV4Lines {
 public:
  explicit BrlcadV4Lines(std::string_view text) : text_(text) {}

  /// Goes to the next line, without its end; false where there is none.
  bool next() {
    if (is_pushed_back_) {
      is_pushed_back_ = false;
      return true;
    }
    if (text_.empty()) return false;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    line_ = text_.substr(0, end);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++number_;
    return true;
  }

  /// Goes to the next line if it isn't another record's first; `letters` begin rows, too.
  bool next_row(std::string_view letters) {
    if (!next()) return false;
    is_pushed_back_ = begins_record() && letters.find(line_.front()) == std::string_view::npos;
    return !is_pushed_back_;
  }

  /// Whether the line's first word is one letter.
  bool begins_record() const {
    return !line_.empty() && std::isalpha(static_cast<unsigned char>(line_.front())) != 0 &&
           (line_.size() == 1 || line_[1] == ' ' || line_[1] == '\t');
  }

  std::string_view line() const { return line_; }
  std::string where() const { return "line " + std::to_string(number_); }

 private:
  std::string_view text_, line_;
  std::size_t number_ = 0;
  bool is_pushed_back_ = false;
};

}  // namespace graycube

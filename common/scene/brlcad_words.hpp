// Words of the text formats: Tcl lists, and numbers as C's scanf takes them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graycube {

/// Cuts Tcl words off a text: `{braced, nested}` as they are, `"quoted"`, or bare; backslashes escape one
/// character in the last two. In a script, words end with their line or at a semicolon.
class TclWords {
 public:
  enum class Ends : bool { kAtLine, kAtText };

  explicit TclWords(std::string_view text, Ends ends = Ends::kAtText) : text_(text), ends_(ends) {}

  /// False when there is none any more (in a script: on this line), or when one has no end (is_broken).
  bool next(std::string& word);
  /// A script's next line with words on it; false at the text's end.
  bool next_line();
  bool is_broken() const { return is_broken_; }
  /// From 1.
  std::size_t line() const { return line_; }

 private:
  bool at_end() const { return at_ >= text_.size(); }
  void skip_blanks();
  void take();
  bool braced(std::string& word);
  bool quoted(std::string& word);

  std::string_view text_;
  Ends ends_;
  std::size_t at_ = 0, line_ = 1;
  bool is_broken_ = false, is_on_line_ = false;
};

/// All words of a list; nothing when one has no end or there are more than `most`.
std::optional<std::vector<std::string>> tcl_list(std::string_view text, std::size_t most);

/// A finite number that is the whole word (a leading + is fine); nothing otherwise.
std::optional<double> parse_brlcad_number(std::string_view word);
std::optional<long> parse_brlcad_integer(std::string_view word);

/// Words between blanks.
std::vector<std::string_view> blank_separated(std::string_view line, std::size_t most);

}  // namespace graycube

// Words of the text formats: Tcl lists, and numbers as C's scanf takes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graycube {

/// Cuts Tcl words off a text: `{braced, nested}` as they are, `"quoted"`, or bare; backslashes
/// escape one character in the last two. In a script (kAtLine), words end with their line or at a
/// semicolon. Lists in lists are read in one pass by kAtBrace: words end at the brace that closes
/// the list.
class TclWords {
 public:
  enum class Ends : std::uint8_t { kAtLine, kAtText, kAtBrace };

  explicit TclWords(std::string_view text, Ends ends = Ends::kAtText) : text_(text), ends_(ends) {}

  /// Takes the next word. False when there is none any more (in a script: on this line), or when
  /// one has no end (is_broken).
  bool next(std::string& word);
  /// Goes to a script's next line that has words; false at the text's end.
  bool next_line();
  bool is_broken() const { return is_broken_; }
  /// Goes into the list that is the next word, or out of the list whose words are done; false when
  /// what comes is something else. For kAtBrace.
  bool open_list() { return take_brace('{'); }
  bool close_list() { return take_brace('}'); }
  bool at_end_of_list();
  /// The line that was reached, from 1.
  std::size_t line() const { return line_; }

 private:
  bool at_end() const { return at_ >= text_.size(); }
  void skip_blanks();
  void take();
  bool take_brace(char brace);
  bool braced(std::string& word);
  bool quoted(std::string& word);

  std::string_view text_;
  Ends ends_;
  std::size_t at_ = 0, line_ = 1;
  bool is_broken_ = false, is_on_line_ = false;
};

/// A finite number that is the whole word (a leading + is fine); nothing otherwise.
std::optional<double> parse_brlcad_number(std::string_view word);
std::optional<long> parse_brlcad_integer(std::string_view word);
/// Appends the numbers of a Tcl list; false when there aren't `count` of them.
bool append_brlcad_numbers(std::string_view list, std::size_t count, std::vector<double>& out);

/// Words between blanks.
std::vector<std::string_view> blank_separated(std::string_view line, std::size_t most);

}  // namespace graycube

// The words of a mesh file's text, with the line that each is on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/close_mesh.hpp"
#include "written_digits.hpp"

namespace graycube {

/// Whether two words are the same but for the case of letters A to Z.
bool equal_words(std::string_view a, std::string_view b);

/// Why bytes that should be text can't be read as such, whatever they say: UTF-16, or compressed.
/// Empty if nothing is known against it.
std::string problem_of_encoding(std::string_view bytes);

/// Cuts a text into words, and counts lines, which end with "\n", "\r\n" or "\r". A byte order mark
/// of UTF-8 at the start counts as space, and so do zeros and the end mark of DOS, with which some
/// programs fill their files up.
class Words {
 public:
  explicit Words(std::string_view text, char comment = '\0');

  /// The next word; empty at the end.
  std::string_view next();
  void skip_line();
  /// The text from here up to where `later`, of the same text, is; without spaces around it.
  std::string_view text_up_to(const Words& later) const;
  /// Whether the rest of this line holds no word.
  bool at_line_end();

  /// These read a word as a number; false if it is none. Numbers too small for a double are 0, too
  /// large ones are none.
  bool read(double& out);
  bool read(std::uint32_t& out);

  MeshFault fault(const std::string& why) const {
    return {"line " + std::to_string(line_) + ": " + why};
  }
  /// The fault that something else than the word read last was expected.
  MeshFault expected(const std::string& what) const;

  std::size_t position() const { return at_; }
  std::size_t left() const { return text_.size() - at_; }
  /// The most significant digits that any double read so far was written with.
  std::uint32_t digits() const { return digits_.most(); }

 private:
  void skip();
  bool ends_line(std::size_t at) const;

  std::string_view text_, last_;
  char comment_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
  WrittenDigits digits_;
};

}  // namespace graycube

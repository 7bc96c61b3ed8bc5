// What openscad says, told once a kind.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/report/import_warnings.hpp"

namespace graycube {

/// Most kinds of warnings, and most different lines of echo(), that are told.
inline constexpr std::size_t kMaxOpenscadMessageKinds = 100;
inline constexpr std::size_t kMaxOpenscadEchoes = 50;

/// The messages of a run that evaluates a model.
class OpenscadMessages {
 public:
  /// Takes a log. Lines that begin with `mark` are kept for the caller, the last of them.
  void read(std::string_view log, std::string_view mark);

  /// The lines with ERROR, and how they came to be.
  const std::vector<std::string>& errors() const { return errors_; }
  /// What stood behind the mark.
  const std::string& marked() const { return marked_; }
  /// Warnings once a kind, with a count, then echoes.
  std::vector<std::string> take_warnings();

 private:
  std::vector<std::string> errors_;
  std::string marked_;
  ImportWarnings warnings_{kMaxOpenscadMessageKinds};
  ImportWarnings echoes_{kMaxOpenscadEchoes};
};

/// The log's lines with errors and warnings, each once, without the name of a folder that is no
/// more.
std::vector<std::string> openscad_troubles(std::string_view log, std::string_view folder);

/// What all messages of a kind have in common: the text without places, numbers and quoted names.
std::string openscad_message_kind(std::string_view line);

}  // namespace graycube

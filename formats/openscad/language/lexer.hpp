// Tokens of a .csg file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace graycube {

struct ScadToken {
  enum class Kind : std::uint8_t {
    kEnd,
    kIdentifier,  // text: a name, perhaps with a $ in front
    kNumber,      // number: unsigned; a minus is a token of its own
    kString,      // text: between the quotes, verbatim
    kSymbol,      // text: one of ( ) { } [ ] , ; = - % # ! *
    kBad,         // no token; the lexer's trouble() tells why
  };
  Kind kind = Kind::kEnd;
  int line = 1;
  double number = 0;
  /// Points into the lexer's text.
  std::string_view text;

  bool is(std::string_view symbol) const { return kind == Kind::kSymbol && text == symbol; }
};

/// Splits a text, which must outlive it. Spaces and comments are skipped; every call but at the end
/// consumes something.
class ScadLexer {
 public:
  explicit ScadLexer(std::string_view text) : text_(text) {}

  /// The next token; kEnd again and again at the end.
  ScadToken next();
  /// The error in the last token that was kBad.
  const std::string& trouble() const { return trouble_; }

 private:
  bool skip_blanks(ScadToken& token);
  ScadToken number();
  ScadToken string();
  ScadToken bad(std::string message);
  /// Moves on to `position`, counting lines.
  void advance_to(std::size_t position);

  std::string_view text_;
  std::size_t position_ = 0;
  int line_ = 1;
  std::string trouble_;
};

}  // namespace graycube

// Recursive descent over JSON text; fills a JsonTree. For json_tree.cpp only.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "scene/json_tree.hpp"

namespace graycube {

class JsonParser {
 public:
  JsonParser(std::string_view text, JsonTree& tree);
  void parse();

 private:
  /// A string as found: a range of the text, or an index into the tree's decoded strings.
  struct Text {
    std::uint32_t begin = 0;
    std::uint32_t length = 0;
    bool decoded = false;
  };

  bool parse_value(std::uint32_t nesting);
  bool parse_container(JsonIndex self, bool object, std::uint32_t nesting);
  bool parse_member(std::uint32_t nesting);
  bool parse_string(Text& out);
  bool decode_string(std::size_t begin, Text& out);
  bool decode_escape(std::string& out);
  bool read_hex4(std::uint32_t& out);
  bool skip_utf8();
  bool parse_number(JsonIndex self);
  bool parse_word(JsonIndex self, std::string_view word, JsonKind kind);
  void skip_space();
  bool fail(std::string message);
  /// What stands at the cursor, for messages.
  std::string found() const;
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  std::string_view text_;
  JsonTree& tree_;
  std::size_t at_ = 0;
};

}  // namespace graycube

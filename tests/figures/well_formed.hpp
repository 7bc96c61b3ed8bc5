// Whether a text is well-formed XML, of the kind that drawings use: elements, attributes in double
// quotes, text and the five entities; no comments, declarations or CDATA.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace graycube::testing {

class XmlReader {
 public:
  explicit XmlReader(std::string_view text) : rest_(text) {}

  /// Empty if the whole text is one element and white space; else what is wrong.
  std::string problem() {
    element();
    while (problem_.empty() && !rest_.empty()) {
      if (std::isspace(static_cast<unsigned char>(rest_.front())) == 0) fail("more than one root");
      take(1);
    }
    return problem_;
  }

 private:
  void fail(const std::string& what) {
    if (problem_.empty()) problem_ = what + " at: " + std::string(rest_.substr(0, 60));
  }
  void take(std::size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }
  bool take(std::string_view expected) {
    if (!rest_.starts_with(expected)) return false;
    take(expected.size());
    return true;
  }
  std::string name() {
    std::string found;
    while (!rest_.empty() && (std::isalnum(static_cast<unsigned char>(rest_.front())) != 0 ||
                              rest_.front() == '-' || rest_.front() == ':')) {
      found += rest_.front();
      take(1);
    }
    if (found.empty()) fail("a name is missing");
    return found;
  }
  /// Text up to one of the ends, which stays.
  void characters(std::string_view ends) {
    while (problem_.empty() && !rest_.empty() && ends.find(rest_.front()) == ends.npos) {
      if (rest_.front() != '&') {
        if (static_cast<unsigned char>(rest_.front()) < 0x20 && rest_.front() != '\n')
          fail("a control character");
        if (rest_.front() == '<' || rest_.front() == '>') fail("markup in text");
        take(1);
      } else if (!take("&lt;") && !take("&gt;") && !take("&amp;") && !take("&quot;") &&
                 !take("&apos;")) {
        fail("an unknown entity");
      }
    }
  }
  void attributes() {
    std::vector<std::string> seen;
    while (problem_.empty() && take(" ")) {
      seen.push_back(name());
      if (std::count(seen.begin(), seen.end(), seen.back()) > 1) fail("an attribute twice");
      if (!take("=\"")) return fail("no value");
      characters("\"");
      if (!take("\"")) return fail("no end of a value");
    }
  }
  void element() {
    if (!take("<")) return fail("no element");
    const std::string opened = name();
    attributes();
    if (take("/>")) return;
    if (!take(">")) return fail("no end of a tag");
    while (problem_.empty() && !rest_.starts_with("</")) {
      if (rest_.empty()) return fail("<" + opened + "> has no end");
      if (rest_.front() == '<') {
        element();
      } else {
        characters("<");
      }
    }
    take(2);
    if (problem_.empty() && name() != opened) fail("not the end of <" + opened + ">");
    if (!take(">")) fail("no end of an end tag");
  }

  std::string_view rest_;
  std::string problem_;
};

inline std::string xml_problem(std::string_view text) { return XmlReader(text).problem(); }

inline std::size_t count(std::string_view text, std::string_view part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace graycube::testing

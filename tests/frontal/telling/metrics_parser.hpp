// Reads Prometheus' text format as strictly as its documents have it, for tests: each family with
// one HELP before one TYPE before its samples, all in one place.
#pragma once

#include <cctype>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace graycube::testing {

/// Numbers by the sample's name with its labels: `a_total{kind="b"}`.
struct ParsedMetrics {
  std::map<std::string, double> samples;
  /// "counter" or "gauge", by the family's name.
  std::map<std::string, std::string> types;
};

class MetricsParser {
 public:
  /// Throws std::runtime_error with the line that is at fault.
  static ParsedMetrics parse(std::string_view text) {
    MetricsParser parser;
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      parser.line_ = text.substr(0, end);
      if (end == text.npos) parser.fail("a line without an end");
      text.remove_prefix(end + 1);
      parser.take_line();
    }
    if (parser.has_open_) parser.fail("a family without samples");
    return std::move(parser.parsed_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error(why + ": " + std::string(line_));
  }
  void take_line() {
    if (line_.starts_with("# HELP ")) return take_help(line_.substr(7));
    if (line_.starts_with("# TYPE ")) return take_type(line_.substr(7));
    take_sample(line_);
  }
  std::string_view take_name(std::string_view& rest, bool has_colons = true) {
    std::size_t n = 0;
    const auto is_of_name = [&](char c) {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' ||
             (has_colons && c == ':') ||
             (n > 0 && std::isdigit(static_cast<unsigned char>(c)) != 0);
    };
    while (n < rest.size() && is_of_name(rest[n])) ++n;
    if (n == 0) fail("a name is expected");
    const std::string_view name = rest.substr(0, n);
    rest.remove_prefix(n);
    return name;
  }
  void expect(std::string_view& rest, char c) {
    if (!rest.starts_with(c)) fail(std::string("expected '") + c + "'");
    rest.remove_prefix(1);
  }
  void take_help(std::string_view rest) {
    if (has_open_) fail("the family before has no samples");
    family_ = take_name(rest);
    expect(rest, ' ');
    if (rest.size() < 10 || rest.back() != '.') fail("a sentence is expected");
    if (!helped_.insert(family_).second) fail("a second HELP");
    has_open_ = true;
  }
  void take_type(std::string_view rest) {
    if (take_name(rest) != family_ || !has_open_) fail("TYPE of another family than HELP");
    expect(rest, ' ');
    if (rest != "counter" && rest != "gauge") fail("an unknown type");
    if ((rest == "counter") != family_.ends_with("_total")) fail("counters alone end in _total");
    if (!parsed_.types.emplace(family_, rest).second) fail("a second TYPE");
  }
  void take_sample(std::string_view rest) {
    const std::string_view whole = rest;
    if (take_name(rest) != family_) fail("a sample outside its family");
    if (!parsed_.types.contains(family_)) fail("a sample before TYPE");
    if (rest.starts_with('{')) take_labels(rest);
    const std::string key(whole.substr(0, whole.size() - rest.size()));
    expect(rest, ' ');
    std::size_t read = 0;
    const std::string number(rest);
    const double value = std::stod(number, &read);
    if (read != number.size()) fail("more than a number");
    if (!parsed_.samples.emplace(key, value).second) fail("a second sample");
    has_open_ = false;
  }
  void take_labels(std::string_view& rest) {
    char before = '{';
    do {
      expect(rest, before);
      take_name(rest, false);
      expect(rest, '=');
      expect(rest, '"');
      while (!rest.empty() && rest.front() != '"') rest.remove_prefix(rest.front() == '\\' ? 2 : 1);
      expect(rest, '"');
      before = ',';
    } while (!rest.starts_with('}'));
    expect(rest, '}');
  }

  ParsedMetrics parsed_;
  std::string_view line_;
  std::string family_;
  std::set<std::string> helped_;
  bool has_open_ = false;
};

}  // namespace graycube::testing

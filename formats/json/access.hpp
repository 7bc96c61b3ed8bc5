// Typed access to a JSON tree. Values that aren't as expected are reported, with what was expected
// and what was found, and the caller goes on: so one run finds all errors.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "formats/json/error_report.hpp"
#include "formats/json/tree.hpp"
#include "geometry/vec.hpp"

namespace graycube {

/// A key that an object may or must have.
struct KeyRule {
  std::string_view name;
  bool required = false;
};

/// The numbers that are accepted, and a name for them in messages.
struct NumberRule {
  std::string_view what;
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
  bool open = false;  // the ends themselves are excluded
};
inline constexpr NumberRule kAnyNumber{.what = "a finite number"};
inline constexpr NumberRule kPositive{.what = "a finite number > 0", .min = 0, .open = true};
inline constexpr NumberRule kNotNegative{.what = "a finite number >= 0", .min = 0};
inline constexpr NumberRule kFraction{.what = "a number from 0 to 1", .min = 0, .max = 1};

/// A word of a closed set and its meaning.
template <typename T>
struct Word {
  std::string_view name;
  T value;
};

class JsonAccess {
 public:
  JsonAccess(const JsonTree& read_from, ErrorReport& report_to)
      : tree(read_from), errors(report_to) {}

  /// Reports "expected WHAT, found …"; false.
  bool wrong(JsonIndex at, std::string_view what);
  bool is_object(JsonIndex at);
  bool is_array(JsonIndex at);
  /// `owner` ("a sphere") goes into messages. out[k] is the member called keys[k].name, 0 when
  /// absent. Reports unknown, duplicate and missing keys; false when a required one is missing or
  /// this is no object.
  bool members(JsonIndex at, std::string_view owner, std::span<const KeyRule> keys,
               std::span<JsonIndex> out);

  /// The functions below leave `out` alone when they return false.
  bool read(JsonIndex at, double& out, const NumberRule& rule = kAnyNumber);
  bool read(JsonIndex at, Vec3& out);
  /// No component may be negative.
  bool read(JsonIndex at, Rgb& out);
  /// A vector with a length that is neither zero nor beyond a double.
  bool read_direction(JsonIndex at, Vec3& out);
  bool read(JsonIndex at, std::uint32_t& out, std::uint32_t min, std::uint32_t max);
  bool read(JsonIndex at, std::string_view& out);
  /// Like read() for a member that may be absent (0): then true, and `out` keeps its default.
  template <typename T, typename... Rule>
  bool read_optional(JsonIndex at, T& out, const Rule&... rule) {
    return at == 0 || read(at, out, rule...);
  }
  /// Reads a word of a closed set; absent (0) keeps the default.
  template <typename T, std::size_t N>
  bool read_word(JsonIndex at, T& out, const std::array<Word<T>, N>& words) {
    std::string_view written;
    if (at == 0) return true;
    if (!read(at, written)) return false;
    std::array<std::string_view, N> names;
    for (std::size_t i = 0; i < N; ++i) {
      names[i] = words[i].name;
      if (names[i] != written) continue;
      out = words[i].value;
      return true;
    }
    return unknown_word(at, names);
  }
  /// Reports a word that is none of `known`; false.
  bool unknown_word(JsonIndex at, std::span<const std::string_view> known);

  const JsonTree& tree;
  ErrorReport& errors;

 private:
  void unknown_key(JsonIndex at, std::string_view owner, std::span<const KeyRule> keys);
  bool read_three(JsonIndex at, std::string_view what, const NumberRule& rule,
                  std::array<double, 3>& out);
};

}  // namespace graycube

#include "formats/openscad/language/exact.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <climits>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

#include "written_digits.hpp"

namespace graycube {
namespace {

constexpr std::string_view kMagic = "graycube|";

/// Modules whose numbers are all to be spelled out, except in the arguments of kOthers.
constexpr std::array<std::string_view, 11> kSpelledOut{
    "cube",    "sphere",     "cylinder",       "polyhedron",     "square", "circle",
    "polygon", "multmatrix", "linear_extrude", "rotate_extrude", "offset"};
/// Arguments whose numbers are whole, or not used by the importer.
constexpr std::array<std::string_view, 7> kOthers{"convexity", "slices",    "segments", "paths",
                                                  "faces",     "triangles", "timestamp"};
constexpr std::array<std::string_view, 5> kFlatBySixDigits{"text", "projection", "import", "fill",
                                                           "resize"};

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The contents of a note.
struct Note {
  std::string_view module;
  struct List {
    std::string_view name;
    std::vector<double> numbers;
  };
  std::vector<List> lists;
};

/// Takes the text up to `end`, and `end` with it; nothing if `end` doesn't occur.
std::optional<std::string_view> take_until(std::string_view& text, char end) {
  const std::size_t at = text.find(end);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at + 1);
  return taken;
}

std::optional<int> whole(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The number that whole numbers spell out, p with its sign; NaN if they are no such number.
double spelled_number(std::span<const int> parts) {
  if (parts.size() == 1) return parts[0];
  constexpr int kMost = 65536;
  const bool good =
      parts.size() == 5 && parts[0] >= -1000 && parts[0] <= 1000 &&
      std::all_of(parts.begin() + 1, parts.end(), [](int v) { return v > -kMost && v < kMost; });
  if (!good) return std::nan("");
  // No more than 53 binary digits are set, so that nothing is rounded.
  double value = 0;
  for (std::size_t i = 4; i > 1; --i) value = (value + parts[i]) / kMost;
  value += parts[1] < 0 ? -parts[1] : parts[1];
  return (parts[1] < 0 ? -1 : 1) * std::ldexp(value, parts[0] - 12);
}

/// The numbers of `[1, [2, 3, 4, 5, 6], undef]`; a word that isn't a whole number gives NaN.
std::vector<double> spelled_numbers(std::string_view list) {
  std::vector<double> numbers;
  std::vector<int> parts;
  int depth = 0;
  while (!list.empty()) {
    const char c = list.front();
    if (c == '[' || c == ']') {
      depth += c == '[' ? 1 : -1;
      if (depth == 1 && c == ']') numbers.push_back(spelled_number(std::exchange(parts, {})));
      list.remove_prefix(1);
    } else if (c == ',' || c == ' ') {
      list.remove_prefix(1);
    } else {
      const std::string_view word = list.substr(0, list.find_first_of(",[] "));
      const auto value = whole(word);
      list.remove_prefix(word.size());
      if (depth > 1) parts.push_back(value.value_or(INT_MAX));
      if (depth == 1) numbers.push_back(value ? *value : std::nan(""));
    }
  }
  return numbers;
}

std::optional<Note> note_in(std::string_view text) {
  if (!text.starts_with(kMagic)) return std::nullopt;
  text.remove_prefix(kMagic.size());
  Note note;
  const auto module = take_until(text, '|');
  if (!module) return std::nullopt;
  note.module = *module;
  while (!text.empty()) {
    const auto name = take_until(text, '=');
    const auto list = name ? take_until(text, '|') : std::nullopt;
    if (!list) return std::nullopt;
    note.lists.push_back({*name, spelled_numbers(*list)});
  }
  return note;
}

/// The only child of a group, or the first of several.
const ScadModule* child_of(const ScadModule& module, bool only) {
  if (module.name != "group" || module.children.empty()) return nullptr;
  return only && module.children.size() > 1 ? nullptr : &module.children.front();
}

/// The note that a module of ours left as its first child, a group around a text().
std::optional<Note> note_of(const ScadModule& module) {
  const ScadModule* first = child_of(module, false);
  const ScadModule* carrier = first != nullptr ? child_of(*first, true) : nullptr;
  if (carrier == nullptr || carrier->name != "text") return std::nullopt;
  const ScadValue* text = carrier->argument("text");
  const auto* words = text != nullptr ? std::get_if<std::string>(&text->value) : nullptr;
  return words != nullptr ? note_in(*words) : std::nullopt;
}

/// The modules in a list, with groups dissolved, since the two trees may group differently; a group
/// that has a note stays whole.
template <typename Module>
void gather(Module& module, std::vector<Module*>& out) {
  if (module.name != "group" || note_of(module)) {
    out.push_back(&module);
    return;
  }
  for (Module& child : module.children) gather(child, out);
}
template <typename Module, typename List>
std::vector<Module*> gathered(List& modules, std::size_t from) {
  std::vector<Module*> out;
  for (std::size_t i = from; i < modules.size(); ++i) gather<Module>(modules[i], out);
  return out;
}

/// Whether `exact` rounded to six digits is `written`, either way if both are as near; or both are
/// as good as zero beside numbers of the size of 1.
bool is_six_digits_of(double written, double exact) {
  constexpr double kNothing = 1e-14;
  if (written == exact || (std::fabs(written) <= kNothing && std::fabs(exact) <= kNothing))
    return true;
  if (!std::isfinite(written) || !std::isfinite(exact)) return false;
  return std::fabs(written - exact) <= (1 + 1e-9) * half_unit(exact, kOpenscadDigits);
}

/// Replaces the numbers in a value, in order; false when the new ones don't agree with them or are
/// too few.
bool replace(ScadValue& value, const std::vector<double>& numbers, std::size_t& next) {
  if (auto* number = std::get_if<double>(&value.value)) {
    if (next == numbers.size() || !is_six_digits_of(*number, numbers[next])) return false;
    *number = numbers[next++];
    return true;
  }
  auto* list = std::get_if<ScadList>(&value.value);
  return list == nullptr || std::all_of(list->begin(), list->end(),
                                        [&](ScadValue& v) { return replace(v, numbers, next); });
}

bool spell_out(ScadModule& plain, const Note& note) {
  if (note.module != plain.name) return false;
  for (std::size_t i = 0; i < plain.arguments.size(); ++i) {
    ScadArgument& argument = plain.arguments[i];
    if (is_among(kOthers, argument.name)) continue;
    // Only multmatrix's argument has no name.
    const std::string_view name =
        argument.name.empty() ? std::string_view("m") : std::string_view(argument.name);
    const auto list = std::find_if(note.lists.begin(), note.lists.end(),
                                   [&](const auto& l) { return l.name == name; });
    const static std::vector<double> kNone;
    const std::vector<double>& numbers = list != note.lists.end() ? list->numbers : kNone;
    // Newer versions of OpenSCAD write one number for several that are equal.
    const bool is_one =
        argument.value.number() != nullptr && numbers.size() > 1 &&
        std::adjacent_find(numbers.begin(), numbers.end(), std::not_equal_to<>()) == numbers.end();
    std::size_t next = 0;
    if (!replace(argument.value, numbers, next) || next != (is_one ? 1 : numbers.size()))
      return false;
  }
  return true;
}

bool spell_out_all(const std::vector<ScadModule*>& plain,
                   const std::vector<const ScadModule*>& marked);

bool spell_out_one(ScadModule& plain, const ScadModule& marked) {
  if (plain.left_out != marked.left_out || plain.root != marked.root) return false;
  const auto note = note_of(marked);
  if (note ? !spell_out(plain, *note)
           : plain.name != marked.name || is_among(kSpelledOut, plain.name))
    return false;
  return spell_out_all(gathered<ScadModule>(plain.children, 0),
                       gathered<const ScadModule>(marked.children, note ? 1 : 0));
}

bool spell_out_all(const std::vector<ScadModule*>& plain,
                   const std::vector<const ScadModule*>& marked) {
  return std::equal(plain.begin(), plain.end(), marked.begin(), marked.end(),
                    [](ScadModule* p, const ScadModule* m) { return spell_out_one(*p, *m); });
}

}  // namespace

bool spell_out(std::vector<ScadModule>& plain, const std::vector<ScadModule>& marked) {
  std::vector<ScadModule> result = plain;
  if (!spell_out_all(gathered<ScadModule>(result, 0), gathered<const ScadModule>(marked, 0)))
    return false;
  plain = std::move(result);
  return true;
}

bool has_flat_parts_of_six_digits(const std::vector<ScadModule>& modules) {
  return std::any_of(modules.begin(), modules.end(), [](const ScadModule& m) {
    return is_among(kFlatBySixDigits, m.name) || has_flat_parts_of_six_digits(m.children);
  });
}

}  // namespace graycube

#include "formats/brlcad/shader_words.hpp"

#include <algorithm>
#include <utility>

#include "formats/brlcad/database/words.hpp"

namespace graycube::brlcad {
namespace {

constexpr std::size_t kMostWords = 256;

/// Cuts a shader up, whichever way its parameters are written.
ShaderWords words_of(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return std::string_view("={},;\"\n").find(c) != std::string_view::npos; }, ' ');
  ShaderWords words;
  for (const std::string_view w : blank_separated(text, kMostWords)) words.emplace_back(w);
  return words;
}

std::vector<ShaderWords> members_of_stack(std::string_view text) {
  std::vector<ShaderWords> members;
  if (text.find(';') != std::string_view::npos) {
    while (!text.empty() && members.size() < kMostWords) {
      const std::size_t end = std::min(text.find(';'), text.size());
      members.push_back(words_of(std::string(text.substr(0, end))));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return members;
  }
  TclWords words(text);
  for (std::string word; members.size() < kMostWords && words.next(word);) {
    members.push_back(words_of(word));
    // A list of the members may itself be in braces.
    if (word.find('{') == 0) return members_of_stack(word);
  }
  return members;
}

}  // namespace

std::vector<ShaderWords> shaders_of(const std::string& shader) {
  const std::size_t start = std::min(shader.find_first_not_of(" \t{"), shader.size());
  const std::string_view text = std::string_view(shader).substr(start);
  constexpr std::string_view kStack = "stack";
  std::vector<ShaderWords> shaders;
  if (text.starts_with(kStack)) {
    shaders = members_of_stack(text.substr(kStack.size()));
  } else if (text.find(';') != std::string_view::npos) {
    shaders = members_of_stack(text);
  } else {
    shaders.push_back(words_of(shader));
  }
  std::erase_if(shaders, [](const ShaderWords& words) { return words.empty(); });
  return shaders;
}

std::optional<double> number_behind(const ShaderWords& words, std::size_t i) {
  return i + 1 < words.size() ? parse_brlcad_number(words[i + 1]) : std::nullopt;
}

std::optional<Vec3> vector_behind(const ShaderWords& words, std::size_t i) {
  constexpr std::size_t kNumbers = 3;
  std::string text;
  for (std::size_t k = i + 1; k < std::min(words.size(), i + 1 + kNumbers); ++k)
    text += words[k] + ' ';
  std::replace(text.begin(), text.end(), '/', ' ');
  std::vector<double> v;
  for (const std::string_view word : blank_separated(text, kNumbers)) {
    const auto number = parse_brlcad_number(word);
    if (!number) return std::nullopt;
    v.push_back(*number);
  }
  if (v.size() != kNumbers) return std::nullopt;
  return Vec3{v[0], v[1], v[2]};
}

Rgb unit_color(const Vec3& v) {
  const double unit = std::max({v.x, v.y, v.z}) > 1 ? 255 : 1;
  return {std::max(0.0, v.x / unit), std::max(0.0, v.y / unit), std::max(0.0, v.z / unit)};
}

}  // namespace graycube::brlcad

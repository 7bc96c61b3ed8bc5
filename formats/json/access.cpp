#include "formats/json/access.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "spelling.hpp"
#include "stop_point.hpp"

namespace graycube {
namespace {

/// The words as a list for messages: "a", "b" and "c".
std::string listed(std::span<const std::string_view> words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += quoted(words[i]);
  }
  return text;
}

/// Advice for a message: the candidate nearest to what was written, else all of them.
std::string advice(std::string_view written, std::span<const std::string_view> known) {
  const std::string nearest = did_you_mean(written, known);
  return nearest.empty() ? "; known are " + listed(known) : nearest;
}

}  // namespace

bool JsonAccess::wrong(JsonIndex at, std::string_view what) {
  if (errors.has_room())
    errors.add(at, "expected " + std::string(what) + ", found " + tree.describe(at));
  else
    errors.count();
  return false;
}

bool JsonAccess::is_object(JsonIndex at) {
  return tree.kind(at) == JsonKind::kObject || wrong(at, "an object");
}

bool JsonAccess::is_array(JsonIndex at) {
  return tree.kind(at) == JsonKind::kArray || wrong(at, "an array");
}

bool JsonAccess::members(JsonIndex at, std::string_view owner, std::span<const KeyRule> keys,
                         std::span<JsonIndex> out) {
  stop_if_asked();
  std::fill(out.begin(), out.end(), 0);
  if (!is_object(at)) return false;
  for (JsonIndex m = tree.first_child(at); m != tree.end(at); m = tree.next(m)) {
    const std::string_view key = tree.key(m);
    const auto rule =
        std::find_if(keys.begin(), keys.end(), [&](const KeyRule& k) { return k.name == key; });
    if (rule == keys.end()) {
      unknown_key(m, owner, keys);
      continue;
    }
    JsonIndex& slot = out[static_cast<std::size_t>(rule - keys.begin())];
    if (slot != 0)
      errors.add(m, "duplicate key " + quoted(key));
    else
      slot = m;
  }
  bool complete = true;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (!keys[k].required || out[k] != 0) continue;
    errors.add(at, std::string(owner) + " needs the key " + quoted(keys[k].name));
    complete = false;
  }
  return complete;
}

void JsonAccess::unknown_key(JsonIndex at, std::string_view owner, std::span<const KeyRule> keys) {
  if (!errors.has_room()) return errors.count();
  std::vector<std::string_view> names;
  for (const auto& k : keys) names.push_back(k.name);
  const std::string_view key = tree.key(at);
  errors.add(at, "unknown key " + quoted(key) + " of " + std::string(owner) + advice(key, names));
}

bool JsonAccess::unknown_word(JsonIndex at, std::span<const std::string_view> known) {
  if (errors.has_room())
    errors.add(at, "unknown word " + tree.describe(at) + advice(tree.string(at), known));
  else
    errors.count();
  return false;
}

bool JsonAccess::read(JsonIndex at, double& out, const NumberRule& rule) {
  if (tree.kind(at) != JsonKind::kNumber) return wrong(at, rule.what);
  const double v = tree.number(at);
  const bool inside = rule.open ? v > rule.min && v < rule.max : v >= rule.min && v <= rule.max;
  if (!inside) return wrong(at, rule.what);
  out = v;
  return true;
}

bool JsonAccess::read_three(JsonIndex at, std::string_view what, const NumberRule& rule,
                            std::array<double, 3>& out) {
  if (tree.kind(at) != JsonKind::kArray || tree.size(at) != 3) return wrong(at, what);
  bool good = true;
  JsonIndex child = tree.first_child(at);
  for (double& v : out) {
    good = read(child, v, rule) && good;
    child = tree.next(child);
  }
  return good;
}

bool JsonAccess::read(JsonIndex at, Vec3& out) {
  std::array<double, 3> v{};
  if (!read_three(at, "a vector [x, y, z]", kAnyNumber, v)) return false;
  out = {v[0], v[1], v[2]};
  return true;
}

bool JsonAccess::read(JsonIndex at, Rgb& out) {
  std::array<double, 3> v{};
  if (!read_three(at, "a colour [red, green, blue]", kNotNegative, v)) return false;
  out = {v[0], v[1], v[2]};
  return true;
}

bool JsonAccess::read_direction(JsonIndex at, Vec3& out) {
  Vec3 v;
  if (!read(at, v)) return false;
  // Lengths that underflow or overflow are refused too: nothing could be normalized by them.
  const double l = length(v);
  if (!(l > 0) || !std::isfinite(l)) return wrong(at, "a vector of finite, non-zero length");
  out = v;
  return true;
}

bool JsonAccess::read(JsonIndex at, std::uint32_t& out, std::uint32_t min, std::uint32_t max) {
  const auto refuse = [&] {
    return wrong(at, min == max ? std::to_string(min)
                                : "a whole number from " + std::to_string(min) + " to " +
                                      std::to_string(max));
  };
  if (tree.kind(at) != JsonKind::kNumber) return refuse();
  const double v = tree.number(at);
  if (!(v >= min && v <= max) || v != std::floor(v)) return refuse();
  out = static_cast<std::uint32_t>(v);
  return true;
}

bool JsonAccess::read(JsonIndex at, std::string_view& out) {
  if (tree.kind(at) != JsonKind::kString) return wrong(at, "a string");
  out = tree.string(at);
  return true;
}

}  // namespace graycube

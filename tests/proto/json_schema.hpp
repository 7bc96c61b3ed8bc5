// Validates JSON by the subset of JSON Schema draft 7 that proto/schema uses: type, const, enum,
// minimum, maximum, maxLength, required, properties, additionalProperties, items, maxItems.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace graycube::test {

using Json = nlohmann::ordered_json;

inline bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "number") return value.is_number();
  if (type == "integer") {
    return value.is_number_integer() ||
           (value.is_number() && std::trunc(value.get<double>()) == value.get<double>());
  }
  return false;
}

/// The number of Unicode characters in a UTF-8 string.
inline std::size_t characters(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80 ? 1 : 0;
  return count;
}

/// Empty when `value` satisfies `schema`; else the place where it doesn't, and the keyword.
inline std::string violation(const Json& schema, const Json& value, const std::string& at = "") {
  static const std::set<std::string> kKnown{
      "$schema", "title",   "description", "type",     "const",      "enum",
      "minimum", "maximum", "maxLength",   "required", "properties", "additionalProperties",
      "items",   "maxItems"};
  for (const auto& [keyword, unused] : schema.items()) {
    if (!kKnown.contains(keyword)) return at + ": the validator doesn't know " + keyword;
  }
  const auto has = [&](const char* keyword) { return schema.contains(keyword); };
  if (has("type") && !has_type(value, schema["type"])) return at + ": type";
  if (has("const") && value != schema["const"]) return at + ": const";
  if (has("enum")) {
    bool found = false;
    for (const Json& allowed : schema["enum"]) found = found || allowed == value;
    if (!found) return at + ": enum";
  }
  if (value.is_number()) {
    if (has("minimum") && value < schema["minimum"]) return at + ": minimum";
    if (has("maximum") && value > schema["maximum"]) return at + ": maximum";
  }
  if (value.is_string() && has("maxLength") &&
      characters(value.get<std::string>()) > schema["maxLength"].get<std::size_t>()) {
    return at + ": maxLength";
  }
  if (value.is_array()) {
    if (has("maxItems") && value.size() > schema["maxItems"].get<std::size_t>())
      return at + ": maxItems";
    for (std::size_t i = 0; has("items") && i < value.size(); ++i) {
      const std::string found = violation(schema["items"], value[i], at + '/' + std::to_string(i));
      if (!found.empty()) return found;
    }
  }
  if (value.is_object()) {
    for (std::size_t i = 0; has("required") && i < schema["required"].size(); ++i) {
      const std::string name = schema["required"][i];
      if (!value.contains(name)) return at + '/' + name + ": required";
    }
    for (const auto& [name, member] : value.items()) {
      if (has("properties") && schema["properties"].contains(name)) {
        const std::string found = violation(schema["properties"][name], member, at + '/' + name);
        if (!found.empty()) return found;
      } else if (has("additionalProperties") && schema["additionalProperties"] == false) {
        return at + '/' + name + ": additionalProperties";
      }
    }
  }
  return "";
}

}  // namespace graycube::test

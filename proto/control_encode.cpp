#include <cmath>
#include <nlohmann/json.hpp>

#include "check.hpp"
#include "proto/control.hpp"
#include "proto/control_fields.hpp"
#include "proto/control_names.hpp"

namespace graycube {
namespace {

// Keeps the fields' order, so that a person reading the wire finds the type first.
using Json = nlohmann::ordered_json;

/// Length of the well-formed UTF-8 sequence at `at`, 0 when there is none (RFC 3629).
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  const unsigned second = byte(1);
  // Refuses overlong forms, surrogates, and code points beyond U+10FFFF.
  if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second >= 0xA0) ||
      (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second >= 0x90)) {
    return 0;
  }
  return length;
}

/// The text without control characters, cut to at most `longest` bytes of UTF-8.
std::string printable(std::string_view text, std::size_t longest) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const auto c = static_cast<unsigned char>(text[i]);
    const std::string_view piece = length == 0             ? std::string_view("?")
                                   : c < 0x20 || c == 0x7F ? std::string_view(" ")
                                                           : text.substr(i, length);
    if (out.size() + piece.size() > longest) break;
    out += piece;
    i += length == 0 ? 1 : length;
  }
  return out;
}

class FieldWriter {
 public:
  explicit FieldWriter(Json& object) : object_(object) {}

  template <class T>
  void operator()(const char* name, const T& value, const FieldLimits& limits = {}) {
    if constexpr (std::is_enum_v<T> || std::is_arithmetic_v<T>) {
      if (limits.is_rare && value == T{}) return;
    }
    if constexpr (requires { value.empty(); }) {
      if (limits.is_rare && value.empty()) return;
    }
    object_[name] = write(value, limits);
  }
  template <class T>
  void operator()(const char* name, const std::optional<T>& value, const FieldLimits& limits = {}) {
    // An estimate is infinite while nothing is known: then the field is left out.
    if constexpr (std::is_same_v<T, double>) {
      if (value && !std::isfinite(*value)) return;
    }
    if (value) object_[name] = write(*value, limits);
  }

 private:
  template <class T>
  static Json write(const T& value, const FieldLimits& limits) {
    if constexpr (std::is_enum_v<T>) {
      const std::string_view name = control_names::name_of(value);
      GRAYCUBE_CHECK(!name.empty(), "enum value %d", static_cast<int>(value));
      return std::string(name);
    } else if constexpr (std::is_same_v<T, std::string>) {
      return printable(value, limits.length);
    } else if constexpr (std::is_same_v<T, double>) {
      GRAYCUBE_CHECK(std::isfinite(value), "%g in a control message", value);
      return value;
    } else if constexpr (std::is_arithmetic_v<T>) {
      return value;
    } else {
      Json object = Json::object();
      FieldWriter visit(object);
      each_field(visit, value);
      return object;
    }
  }
  template <class T>
  static Json write(const std::vector<T>& values, const FieldLimits& limits) {
    GRAYCUBE_CHECK(values.size() <= limits.length, "%zu of at most %zu elements", values.size(),
                   limits.length);
    FieldLimits element = limits;
    element.length = kMaxNameBytes;
    Json array = Json::array();
    for (const T& value : values) array.push_back(write(value, element));
    return array;
  }
  static Json write(const RawObject& raw, const FieldLimits& limits) {
    Json object = Json::parse(raw.text, nullptr, false);
    GRAYCUBE_CHECK(object.is_object() && raw.text.size() <= limits.length,
                   "%zu bytes that should be a JSON object", raw.text.size());
    return object;
  }

  Json& object_;
};

}  // namespace

std::string encode(const ControlMessage& message) {
  Json json = Json::object();
  json["graycube"] = kControlVersion;
  json["type"] = std::string(type_of(message));
  FieldWriter visit(json);
  std::visit([&](const auto& m) { each_field(visit, m); }, message);
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  GRAYCUBE_CHECK(text.size() <= kMaxControlBytes, "%zu bytes of %s", text.size(),
                 type_of(message).data());
  return text;
}

}  // namespace graycube

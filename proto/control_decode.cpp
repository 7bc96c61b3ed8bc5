#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "proto/control.hpp"
#include "proto/control_fields.hpp"
#include "proto/control_names.hpp"

namespace graycube {
namespace {

using Json = nlohmann::ordered_json;

/// Doubles hold integers exactly up to here; some senders write whole numbers as 3.0.
constexpr double kMaxExactInteger = 9007199254740992.0;  // 2^53

std::string name_list(std::span<const std::string_view> names) {
  std::string list;
  for (const std::string_view name : names) {
    if (!list.empty()) list += ", ";
    list += name;
  }
  return list;
}

/// Reads the fields of one object; the first fault, in whatever depth, is kept in `error`.
class FieldReader {
 public:
  FieldReader(const Json& object, std::string path, std::optional<ControlError>& error)
      : object_(object), path_(std::move(path)), error_(error) {}

  template <class T>
  void operator()(const char* name, T& value, const FieldLimits& limits = {}) {
    const Json* json = find(name);
    if (json != nullptr) return read(*json, path_ + name, value, limits);
    if (!limits.has_default) fail(path_ + name, "missing");
  }
  template <class T>
  void operator()(const char* name, std::optional<T>& value, const FieldLimits& limits = {}) {
    if (const Json* json = find(name)) read(*json, path_ + name, value.emplace(), limits);
  }

 private:
  const Json* find(const char* name) const {
    const auto it = object_.find(name);
    return it != object_.end() ? &*it : nullptr;
  }
  void fail(const std::string& field, std::string why) {
    if (!error_) error_ = ControlError{field, std::move(why)};
  }

  void read(const Json& json, const std::string& field, bool& value, const FieldLimits&) {
    if (!json.is_boolean()) return fail(field, "must be true or false");
    value = json.get<bool>();
  }

  template <std::integral T>
  void read(const Json& json, const std::string& field, T& value, const FieldLimits& limits) {
    bool fits = false;
    if (json.is_number_unsigned()) {
      const auto v = json.get<std::uint64_t>();
      fits = std::in_range<T>(v);
      value = static_cast<T>(v);
    } else if (json.is_number_integer()) {
      const auto v = json.get<std::int64_t>();
      fits = std::in_range<T>(v);
      value = static_cast<T>(v);
    } else if (json.is_number_float()) {
      const double v = json.get<double>();
      if (std::trunc(v) != v) return fail(field, "must be an integer");
      if (std::fabs(v) <= kMaxExactInteger) {
        const auto whole = static_cast<std::int64_t>(v);
        fits = std::in_range<T>(whole);
        value = static_cast<T>(whole);
      }
    } else {
      return fail(field, "must be an integer");
    }
    const auto v = static_cast<double>(value);
    if (!fits || v < limits.min || v > limits.max) fail(field, "out of range");
  }

  void read(const Json& json, const std::string& field, double& value, const FieldLimits& limits) {
    if (!json.is_number()) return fail(field, "must be a number");
    value = json.get<double>();
    if (!std::isfinite(value) || value < limits.min || value > limits.max)
      fail(field, "out of range");
  }

  void read(const Json& json, const std::string& field, std::string& value,
            const FieldLimits& limits) {
    if (!json.is_string()) return fail(field, "must be a string");
    const auto& text = json.get_ref<const std::string&>();
    if (text.size() > limits.length) {
      return fail(field, "longer than " + std::to_string(limits.length) + " bytes");
    }
    for (const char c : text) {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
        return fail(field, "control characters");
    }
    value = text;
  }

  template <class E>
  requires std::is_enum_v<E>
  void read(const Json& json, const std::string& field, E& value, const FieldLimits&) {
    if (!json.is_string()) return fail(field, "must be a string");
    const auto& all = control_names::Names<E>::kAll;
    const std::string_view name = json.get_ref<const std::string&>();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] == name) {
        value = static_cast<E>(i);
        return;
      }
    }
    fail(field, "must be one of " + name_list(all));
  }

  void read(const Json& json, const std::string& field, RawObject& value,
            const FieldLimits& limits) {
    if (!json.is_object()) return fail(field, "must be an object");
    value.text = json.dump();
    if (value.text.size() > limits.length) {
      fail(field, "longer than " + std::to_string(limits.length) + " bytes");
    }
  }

  template <class T>
  void read(const Json& json, const std::string& field, std::vector<T>& values,
            const FieldLimits& limits) {
    if (!json.is_array()) return fail(field, "must be an array");
    if (json.size() > limits.length) {
      return fail(field, "more than " + std::to_string(limits.length) + " elements");
    }
    FieldLimits element = limits;
    element.length = kMaxNameBytes;
    values.resize(json.size());
    for (std::size_t i = 0; i < values.size() && !error_; ++i) {
      read(json[i], field + '/' + std::to_string(i), values[i], element);
    }
  }

  template <class T>
  requires std::is_class_v<T>
  void read(const Json& json, const std::string& field, T& value, const FieldLimits&) {
    if (!json.is_object()) return fail(field, "must be an object");
    FieldReader visit(json, field + '/', error_);
    each_field(visit, value);
  }

  const Json& object_;
  std::string path_;
  std::optional<ControlError>& error_;
};

// ---- rules that tie several fields of one message

using Fault = std::optional<ControlError>;

template <class Message>
Fault fault_of(const Message&) {
  return {};
}

Fault fault_of_edges(const char* field, std::uint32_t cells,
                     const std::vector<std::int64_t>& edges) {
  if (edges.size() + 1 != cells) return ControlError{field, "must be one fewer than the cells"};
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i] <= edges[i - 1]) return ControlError{field, "must increase strictly"};
  }
  return {};
}

Fault fault_of_own_edges(const control::GridLayout& grid) {
  constexpr const char* kField = "grid/own_edges";
  if (grid.own_edges.empty()) return {};
  const std::size_t each = grid.columns - 1;
  if (grid.own_edges.size() != each * grid.rows)
    return ControlError{kField, "must be one fewer than the columns for each row"};
  for (std::size_t i = 1; i < grid.own_edges.size(); ++i) {
    if (i % each != 0 && grid.own_edges[i] <= grid.own_edges[i - 1])
      return ControlError{kField, "must increase strictly in each row"};
  }
  return {};
}

Fault fault_of_slab_depths(const control::GridLayout& grid) {
  double last = 0;
  for (const double depth : grid.slab_depths) {
    if (!(depth > last)) {
      return ControlError{"grid/slab_depths", "must be above 0 and increase strictly"};
    }
    last = depth;
  }
  return {};
}

Fault fault_of(const control::Load& m) {
  if (m.algorithm != Algorithm::kRoth && m.algorithm != Algorithm::kMacro) {
    return ControlError{"algorithm", "must be one of roth, macro"};
  }
  if (m.grid.columns % m.grid.scatter != 0 || m.grid.rows % m.grid.scatter != 0) {
    return ControlError{"grid/scatter", "must divide columns and rows"};
  }
  if (Fault fault = fault_of_edges("grid/column_edges", m.grid.columns, m.grid.column_edges))
    return fault;
  if (Fault fault = fault_of_edges("grid/row_edges", m.grid.rows, m.grid.row_edges)) return fault;
  if (Fault fault = fault_of_slab_depths(m.grid)) return fault;
  return fault_of_own_edges(m.grid);
}

Fault fault_of(const control::Welcome& m) {
  if (m.endpoints.size() != m.nodes) return ControlError{"endpoints", "must be as many as nodes"};
  return {};
}

Fault fault_of(const control::Picture& m) {
  if (m.first_row + m.rows > m.height) return ControlError{"rows", "beyond the picture's height"};
  if (std::uint64_t{m.rows} * m.width * 12 > kMaxPictureBytes)
    return ControlError{"rows", "too many"};
  return {};
}

Fault fault_of(const control::JobInfo& m) {
  if (m.tiles_whole > m.tiles) return ControlError{"tiles_whole", "more than tiles"};
  return {};
}

Fault fault_of(const control::Progress& m) {
  if (m.tiles_whole > m.tiles) return ControlError{"tiles_whole", "more than tiles"};
  return {};
}

Fault fault_of(const control::Jobs& m) {
  for (std::size_t i = 0; i < m.jobs.size(); ++i) {
    if (Fault fault = fault_of(m.jobs[i])) {
      return ControlError{"jobs/" + std::to_string(i) + '/' + fault->field, fault->why};
    }
  }
  return {};
}

// ---- the whole message

/// Whether arrays and objects nest deeper than the limit, found before the parser builds any of
/// them.
bool nests_too_deeply(std::string_view text) {
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxControlNesting) return true;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return false;
}

template <class Message>
ControlResult decode_as(const Json& json) {
  Message message;
  Fault error;
  FieldReader visit(json, "", error);
  each_field(visit, message);
  if (!error) error = fault_of(message);
  if (error) return *std::move(error);
  return ControlMessage(std::move(message));
}

template <std::size_t... Index>
ControlResult decode_type(std::string_view type, const Json& json, std::index_sequence<Index...>) {
  ControlResult result = ControlError{"type", "unknown"};
  const auto attempt = [&]<class Message>(std::type_identity<Message>) {
    if (type != Message::kType) return false;
    result = decode_as<Message>(json);
    return true;
  };
  (attempt(std::type_identity<std::variant_alternative_t<Index, ControlMessage>>{}) || ...);
  return result;
}

}  // namespace

ControlResult decode(std::string_view text) {
  if (text.size() > kMaxControlBytes)
    return ControlError{"", "longer than a control message may be"};
  if (nests_too_deeply(text)) return ControlError{"", "nested too deeply"};
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return ControlError{"", "not a JSON object"};
  const auto version = json.find("graycube");
  if (version == json.end()) return ControlError{"graycube", "missing"};
  if (!version->is_number_integer() || *version != kControlVersion) {
    return ControlError{"graycube", "unknown version"};
  }
  const auto type = json.find("type");
  if (type == json.end()) return ControlError{"type", "missing"};
  if (!type->is_string()) return ControlError{"type", "must be a string"};
  return decode_type(type->get_ref<const std::string&>(), json,
                     std::make_index_sequence<std::variant_size_v<ControlMessage>>{});
}

}  // namespace graycube

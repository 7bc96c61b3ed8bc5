// proto/schema and the decoder must say the same: each is checked against the other.
#include <filesystem>
#include <fstream>
#include <set>

#include "catch.hpp"
#include "proto/control.hpp"
#include "proto/control_examples.hpp"
#include "proto/json_schema.hpp"

using namespace graycube;
using namespace graycube::test;

namespace {

std::filesystem::path schema_path(std::string_view type) {
  return std::filesystem::path(GRAYCUBE_SCHEMA_DIR) / (std::string(type) + ".schema.json");
}

Json schema_of(std::string_view type) {
  std::ifstream file(schema_path(type));
  INFO(type);
  REQUIRE(file);
  return Json::parse(file);
}

bool is_accepted(const Json& json) { return decode(json.dump()).index() == 0; }

/// Calls visit(pointer, schema of the object, object) for every object in `value` that its schema
/// describes.
template <class Visit>
void each_object(const Json& schema, const Json& value, const Json::json_pointer& at,
                 Visit&& visit) {
  if (value.is_object() && schema.contains("properties")) {
    visit(at, schema, value);
    for (const auto& [name, property] : schema["properties"].items()) {
      if (value.contains(name)) each_object(property, value[name], at / name, visit);
    }
  }
  if (value.is_array() && schema.contains("items")) {
    for (std::size_t i = 0; i < value.size(); ++i)
      each_object(schema["items"], value[i], at / i, visit);
  }
}

/// Pointers to every value in `json` but the whole: leaves, objects and arrays.
std::set<std::string> all_pointers(const Json& json) {
  std::set<std::string> pointers;
  const Json leaves = json.flatten();
  for (const auto& [leaf, unused] : leaves.items()) {
    for (Json::json_pointer at(leaf); !at.empty(); at.pop_back()) pointers.insert(at.to_string());
  }
  return pointers;
}

/// Fields that rules tie together, which the schemas' words can't express.
const std::set<std::string> kTiedFields{
    "grid/scatter",       "grid/column_edges", "grid/row_edges", "grid/own_edges",
    "grid/slab_depths",   "endpoints",         "rows",           "tiles_whole",
    "jobs/0/tiles_whole", "jobs/1/tiles_whole"};

std::vector<Json> probes() {
  return {nullptr,
          true,
          -1,
          0,
          1,
          2,
          1.5,
          3.0,
          1024,
          1025,
          70000,
          5e9,
          -2e9,
          "",
          "auto",
          "tile",
          std::string(300, 'x'),
          std::string(1100, 'x'),
          Json::array(),
          Json::array({1}),
          Json::array({"a"}),
          Json(std::vector<int>(5000, 1)),
          Json::object(),
          Json{{"a", 1}}};
}

}  // namespace

TEST_CASE("every message has a schema file, and every schema file a message") {
  std::set<std::string> files, types;
  for (const auto& entry : std::filesystem::directory_iterator(GRAYCUBE_SCHEMA_DIR)) {
    files.insert(entry.path().filename().string());
  }
  for (const std::string_view type : control_types())
    types.insert(std::string(type) + ".schema.json");
  CHECK(files == types);
}

TEST_CASE("what is encoded satisfies its schema") {
  for (const ControlMessage& message : example_messages()) {
    INFO(encode(message));
    CHECK(violation(schema_of(type_of(message)), Json::parse(encode(message))) == "");
  }
}

TEST_CASE("the schemas describe every field that is encoded") {
  for (const ControlMessage& message : example_messages()) {
    each_object(schema_of(type_of(message)), Json::parse(encode(message)), Json::json_pointer(),
                [&](const auto& at, const Json& schema, const Json& object) {
                  for (const auto& [name, unused] : object.items()) {
                    INFO(type_of(message) << ' ' << (at / name));
                    CHECK(schema["properties"].contains(name));
                  }
                });
  }
}

TEST_CASE("a field is required by the schema exactly when decode demands it") {
  int dropped = 0;
  for (const ControlMessage& message : example_messages()) {
    const Json whole = Json::parse(encode(message));
    REQUIRE(is_accepted(whole));
    each_object(schema_of(type_of(message)), whole, Json::json_pointer(),
                [&](const auto& at, const Json& schema, const Json& object) {
                  for (const auto& [name, unused] : schema["properties"].items()) {
                    if (!object.contains(name)) continue;
                    Json without = whole;
                    without[at].erase(name);
                    const auto& required = schema["required"];
                    const bool demanded =
                        std::find(required.begin(), required.end(), name) != required.end();
                    INFO(type_of(message) << ' ' << (at / name));
                    CHECK(is_accepted(without) == !demanded);
                    ++dropped;
                  }
                });
  }
  CHECK(dropped > 150);
}

TEST_CASE("for any value in any field, schema and decoder agree whether it may stand there") {
  const std::vector<Json> values = probes();
  int accepted = 0, refused = 0;
  for (const ControlMessage& message : example_messages()) {
    const Json schema = schema_of(type_of(message));
    const Json whole = Json::parse(encode(message));
    for (const std::string& pointer : all_pointers(whole)) {
      const Json::json_pointer at(pointer);
      for (const Json& value : values) {
        // The longest one only where an array stands, to save time.
        if (value.size() > 1000 && !whole[at].is_array()) continue;
        Json changed = whole;
        changed[at] = value;
        // Another type is another message, with another schema.
        if (changed["type"] != whole["type"]) continue;
        const std::string wrong = violation(schema, changed);
        const ControlResult result = decode(changed.dump());
        const auto* error = std::get_if<ControlError>(&result);
        ++(error == nullptr ? accepted : refused);
        if (wrong.empty() && error != nullptr && kTiedFields.contains(error->field)) continue;
        if (wrong.empty() == (error == nullptr)) continue;
        FAIL_CHECK(type_of(message)
                   << ' ' << at << " = " << value.dump().substr(0, 60) << "\n  schema: " << wrong
                   << "\n  decode: "
                   << (error != nullptr ? error->field + ": " + error->why : "accepted"));
      }
    }
  }
  CHECK(accepted > 500);
  CHECK(refused > 500);
}

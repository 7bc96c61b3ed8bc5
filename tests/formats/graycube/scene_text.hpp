// A small valid scene file whose parts tests replace.
#pragma once

#include <map>
#include <string>

namespace graycube::testing {

class SceneText {
 public:
  /// Replaces or adds a top-level key.
  SceneText& with(const std::string& key, const std::string& json) {
    parts_[key] = json;
    return *this;
  }
  SceneText& without(const std::string& key) {
    parts_.erase(key);
    return *this;
  }
  std::string text() const {
    std::string all = "{";
    for (const auto& [key, json] : parts_)
      all += (all.size() > 1 ? ",\n" : "\n") + ("\"" + key + "\": ") + json;
    return all + "\n}";
  }

  /// One object of material "red" with the given CSG node.
  static SceneText of_csg(const std::string& csg) {
    return SceneText().with("objects", R"([{"material": "red", "csg": )" + csg + "}]");
  }

 private:
  std::map<std::string, std::string> parts_{
      {"graycube", "1"},
      {"image", R"({"width": 8, "height": 6})"},
      {"camera",
       R"({"type": "perspective", "eye": [0,0,-5], "look_at": [0,0,0], "up": [0,1,0], "fov": 40})"},
      {"lights", "[]"},
      {"materials", R"({"red": {"color": [1,0,0]}, "glass": {}})"},
      {"shapes", R"({"ball": {"type": "sphere", "center": [0,0,0], "radius": 1}})"},
      {"objects", "[]"}};
};

}  // namespace graycube::testing

// Reads files of this folder.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "catch.hpp"

namespace graycube::testing {

/// A file of this folder, which the build names, as OpenSCAD wrote it.
inline std::string fixture(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(GRAYCUBE_FIXTURES) / name;
  std::ifstream file(path, std::ios::binary);
  INFO(path);
  REQUIRE(file.good());
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace graycube::testing

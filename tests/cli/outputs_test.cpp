#include "cli/outputs.hpp"

#include "cli/expect_failure.hpp"
#include "cli/temporary_folder.hpp"

namespace graycube {
namespace {

bool says(const std::string& line, const char* part) {
  return line.find(part) != std::string::npos;
}

TEST_CASE("a picture goes by the scene's name, in the current folder") {
  CHECK(default_exr("some/where/plate.json") == "plate.exr");
  CHECK(default_exr("plate.v2.csg") == "plate.v2.exr");
}

TEST_CASE("outputs that can be written pass") {
  const TemporaryFolder folder;
  write_file(folder / "old.exr", "to be replaced");
  CHECK_NOTHROW(check_outputs({folder / "old.exr", folder / "a.png", folder / "a.json"},
                              folder / "scene.json"));
  CHECK_NOTHROW(check_outputs({}, "scene.json"));
}

TEST_CASE("outputs that could not be written after a long render are refused before it") {
  const TemporaryFolder folder;
  const auto line = [&](const Outputs& outputs) {
    return refusal([&] { check_outputs(outputs, folder / "scene.json"); });
  };
  CHECK(says(line({folder / "none/a.exr", {}, {}}), "the folder does not exist"));
  CHECK(says(line({folder.path(), {}, {}}), "found a folder"));
  CHECK(says(line({"/dev/null", {}, {}}), "not a regular file"));
  CHECK(says(line({folder / "a.exr", {}, folder / "a.exr"}), "is also what -o names"));
  CHECK(says(line({folder / "a.exr", folder / "./a.exr", {}}), "is also what -o names"));
  CHECK(says(line({folder / "scene.json", {}, {}}), "would replace the input"));
  CHECK(says(line({folder / "a.png", {}, {}}), "for PNG use --png"));
}

TEST_CASE("a picture's name must end as the file that is written is called, in whatever case") {
  const TemporaryFolder folder;
  const auto line = [&](const Outputs& outputs) {
    return refusal([&] { check_outputs(outputs, folder / "scene.json"); });
  };
  for (const char* name : {"a.jpg", "a.json", "a", "-", "a.exr.bak"}) {
    INFO(name);
    CHECK(says(line({folder / name, {}, {}}), "expected a name ending in .exr"));
    CHECK(says(line({{}, folder / name, {}}), "expected a name ending in .png"));
  }
  CHECK_NOTHROW(check_outputs({folder / "A.EXR", folder / "a.linear.PNG", {}}, "scene.json"));
}

TEST_CASE("a text file appears whole under its name, and nothing beside it") {
  const TemporaryFolder folder;
  write_text_file(folder / "a.json", "{}\n");
  CHECK(file_text(folder / "a.json") == "{}\n");
  const auto entries = std::filesystem::directory_iterator(folder.path());
  CHECK(std::distance(begin(entries), end(entries)) == 1);
  CHECK_THROWS_AS(write_text_file(folder / "none/a.json", "{}"), Failure);
}

}  // namespace
}  // namespace graycube

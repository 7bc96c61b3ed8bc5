// graycube render: its files, its statistics, its progress, its limits.

#include "catch.hpp"
#include "film/picture_files.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

using Json = nlohmann::json;

Json render_stats(Sandbox& sandbox, const std::string& scene, Arguments options) {
  options.insert(options.begin(),
                 {"render", scene_file(scene).string(), "--stats", "s.json", "-q"});
  const Outcome o = sandbox.run(options);
  INFO(o.err);
  REQUIRE(o.status == 0);
  return sandbox.json("s.json");
}

TEST_CASE("the first scene is rendered on 8 nodes in seconds, and says how") {
  Sandbox sandbox;
  const Outcome o = sandbox.run({"render", scene_file("first.json").string(), "-n", "8",
                                 "--algorithm", "macro", "--png", "a.png", "--stats", "a.json"});
  INFO(o.out << o.err);
  REQUIRE(o.status == 0);
  CHECK(o.err.empty());
  CHECK(sandbox.files() == std::vector<std::string>{"a.json", "a.png", "first.exr"});
  const Picture picture = read_exr(sandbox / "first.exr");
  CHECK(picture.width == 256);
  CHECK(picture.height == 256);
  CHECK(read_png(sandbox / "a.png").bits == 8);
  CHECK(o.out.find("whether all is done") != std::string::npos);
  CHECK(lines_of(o.out).back().starts_with("first.exr: 256 x 256, macro on 8 nodes, "));
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("render --json tells its progress and what it wrote, a line of JSON each") {
  for (const char* algorithm : {"serial", "macro"}) {
    Sandbox sandbox;
    const Outcome o =
        sandbox.run({"render", scene_file("first.json").string(), "-o", "a \"b\".exr", "-n", "2",
                     "--algorithm", algorithm, "--size", "48x32", "--json"});
    INFO(algorithm << ": " << o.out << o.err);
    REQUIRE(o.status == 0);
    std::vector<Json> lines;
    for (const std::string& line : lines_of(o.out)) lines.push_back(Json::parse(line));
    REQUIRE(lines.size() >= 2);
    CHECK(lines.front()["type"] == "progress");
    CHECK(lines.back()["exr"] == "a \"b\".exr");
    CHECK(lines.back()["width"] == 48);
    CHECK(lines.back()["height"] == 32);
    CHECK(lines.back()["wall_s"] > 0);
    CHECK_FALSE(file_bytes(sandbox / "a \"b\".exr").empty());
  }
}

TEST_CASE("a picture whose name is no UTF-8 is the same as any other") {
  Sandbox sandbox;
  for (const char* name : {"plain.exr", "odd\xff.exr"}) {
    const Outcome o = sandbox.run({"render", scene_file("first.json").string(), "-n", "4",
                                   "--algorithm", "macro", "-q", "-o", name});
    INFO(o.err);
    REQUIRE(o.status == 0);
  }
  CHECK(read_exr(sandbox / "plain.exr") == read_exr(sandbox / "odd\xff.exr"));
  CHECK(sandbox.files().size() == 2);
}

TEST_CASE("a macro render's statistics add up") {
  Sandbox sandbox;
  const Json serial = render_stats(sandbox, "mirrors.json", {"--algorithm", "serial"});
  const Json s = render_stats(sandbox, "mirrors.json", {"--algorithm", "macro", "-n", "8"});
  CHECK(s["graycube"] == serial["graycube"]);
  CHECK(s["scene"] == "mirrors.json");
  CHECK(s["algorithm"] == "macro");
  CHECK(s["nodes"] == 8);
  CHECK(s["threads"] == 1);
  CHECK(s["dimension"] == 3);
  CHECK(s["grid"] == Json::array({4, 2}));
  CHECK(s["image"] == serial["image"]);
  CHECK(s["primitives"] == serial["primitives"]);
  CHECK(s["objects"] == serial["objects"]);
  CHECK(s["rays"] == serial["rays"]);
  CHECK(s["rays"]["primary"] == 256 * 256);
  CHECK(s["token"]["rounds"] >= 1);
  CHECK(s["token"]["rounds"] <= 4);
  CHECK(s["forwarded"]["shadow"] > 0);
  CHECK(s["forwarded"]["secondary"] > 0);
  CHECK(s["messages"]["contribution_batches"] > 0);
  CHECK(s["balance"]["efficiency"] > 0);
  CHECK(s["balance"]["efficiency"] <= 1);
  REQUIRE(s["per_node"].size() == 8);
  double cpu_s = 0, start_cpu_s = 0;
  std::uint64_t rays_in = 0, rays_out = 0;
  for (std::size_t rank = 0; rank < 8; ++rank) {
    const Json& n = s["per_node"][rank];
    CHECK(n["rank"] == rank);
    CHECK(n["busy_s"] <= n["cpu_s"]);
    CHECK(n["peak_rss_bytes"] > 0);
    CHECK(n["start_cpu_s"] > 0);
    CHECK(n["start_cpu_s"].get<double>() + n["busy_s"].get<double>() <= n["cpu_s"]);
    cpu_s += n["cpu_s"].get<double>();
    start_cpu_s += n["start_cpu_s"].get<double>();
    rays_in += n["rays_in"].get<std::uint64_t>();
    rays_out += n["rays_out"].get<std::uint64_t>();
  }
  CHECK(rays_in == rays_out);
  CHECK(s["cpu_s"] >= cpu_s);
  CHECK(s["start_cpu_s"] > start_cpu_s);
  CHECK(s["start_cpu_s"] < s["cpu_s"]);
  CHECK(s["wall_s"] >= s["phases"]["render_s"]);
}

TEST_CASE("a serial render's statistics have the same shape as a farm's") {
  Sandbox sandbox;
  const Json serial =
      render_stats(sandbox, "mirrors.json", {"--algorithm", "serial", "--threads", "2"});
  const Json farm = render_stats(sandbox, "mirrors.json", {"--algorithm", "macro", "-n", "1"});
  const auto keys = [](const Json& object) {
    std::vector<std::string> names;
    for (const auto& [key, value] : object.items()) names.push_back(key);
    return names;
  };
  CHECK(keys(serial) == keys(farm));
  CHECK(keys(serial["per_node"][0]) == keys(farm["per_node"][0]));
  CHECK(serial["nodes"] == 1);
  CHECK(serial["threads"] == 2);
  CHECK(serial["token"]["rounds"] == 0);
  REQUIRE(serial["per_node"].size() == 1);
  const Json& node = serial["per_node"][0];
  CHECK(node["primitives"] == serial["primitives"]);
  CHECK(node["busy_s"] > 0);
  CHECK(node["busy_s"] <= serial["cpu_s"]);
  CHECK(serial["cpu_s"] > 0);
  CHECK(serial["start_cpu_s"] == 0);
}

TEST_CASE("in macro no node holds the whole scene, and more nodes hold less each") {
  Sandbox sandbox;
  const auto largest_share = [&](const char* nodes) {
    const Json s = render_stats(sandbox, "scatter1000.json",
                                {"--algorithm", "macro", "-n", nodes, "--size", "64x48"});
    std::uint64_t most = 0;
    for (const Json& n : s["per_node"]) most = std::max(most, n["primitives"].get<std::uint64_t>());
    return static_cast<double>(most) / s["primitives"].get<double>();
  };
  const double on_4 = largest_share("4"), on_16 = largest_share("16");
  CHECK(on_4 < 0.7);
  CHECK(on_16 < 0.4);
  CHECK(on_16 < on_4);
}

TEST_CASE("a render's time limit ends it with status 1, and nothing stays") {
  Sandbox sandbox;
  for (const char* algorithm : {"serial", "roth", "macro"}) {
    const Outcome o =
        sandbox.run({"render", scene_file("glass.json").string(), "--size", "4000x4000",
                     "--algorithm", algorithm, "-n", "4", "--timeout", "0.4", "-q"});
    INFO(algorithm << ": " << o.err);
    CHECK(o.status == 1);
    CHECK(o.err == "graycube: render: --timeout: it did not end in time\n");
    CHECK(sandbox.files().empty());
    CHECK(sandbox.processes().empty());
    CHECK(sandbox.temporary_files().empty());
  }
}

TEST_CASE("a time limit that suffices changes nothing") {
  Sandbox sandbox;
  const Outcome o = sandbox.run(
      {"render", scene_file("first.json").string(), "--size", "32x32", "--timeout", "50", "-q"});
  CHECK(o.status == 0);
  CHECK(o.out.empty());
  CHECK(o.err.empty());
}

TEST_CASE("overrides decide size, samples and depth") {
  Sandbox sandbox;
  const Json s = render_stats(
      sandbox, "mirrors.json",
      {"--algorithm", "roth", "--size", "40x24", "--samples", "2", "--max-depth", "0"});
  CHECK(s["image"] == Json{{"width", 40}, {"height", 24}, {"samples", 2}});
  CHECK(s["rays"]["primary"] == 40 * 24 * 4);
  CHECK(s["rays"]["reflection"] == 0);
}

TEST_CASE("a picture becomes a PNG by conversion just as by rendering") {
  Sandbox sandbox;
  for (const char* name : {"a.png", "a.linear.png"}) {
    REQUIRE(sandbox
                .run({"render", scene_file("first.json").string(), "--size", "48x32", "-o", "a.exr",
                      "--png", name, "-q"})
                .status == 0);
    const std::string other = std::string("b") + (name + 1);
    REQUIRE(sandbox.run({"convert", "a.exr", other}).status == 0);
    CHECK((file_bytes(sandbox / other) == file_bytes(sandbox / name)));
  }
  CHECK(read_png(sandbox / "b.linear.png").bits == 16);
}

TEST_CASE("a scene converted to a scene gives the same picture") {
  Sandbox sandbox;
  REQUIRE(sandbox.run({"convert", scene_file("mirrors.json").string(), "m.json"}).status == 0);
  for (const auto& [scene, out] :
       {std::pair{scene_file("mirrors.json"), "a.exr"}, {sandbox / "m.json", "b.exr"}}) {
    REQUIRE(sandbox
                .run({"render", scene.string(), "--algorithm", "serial", "--size", "64x64", "-o",
                      out, "-q"})
                .status == 0);
  }
  // The header names the scene, so the files differ there.
  CHECK((read_exr(sandbox / "a.exr") == read_exr(sandbox / "b.exr")));
  REQUIRE(sandbox.run({"convert", scene_file("mirrors.json").string(), "m.pov"}).status == 0);
  CHECK(file_bytes(sandbox / "m.pov").find("camera") != std::string::npos);
}

}  // namespace
}  // namespace graycube

// One scene, one picture: byte for byte, whatever computes it.
#include <algorithm>
#include <cstdlib>

#include "catch.hpp"
#include "geometry/simd.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

/// The pictures' size here: small enough for a quick test, large enough for every macro-region of
/// 32 nodes.
constexpr const char* kSize = "96x64";
/// For pictures whose pixels take many rays.
constexpr const char* kSmallSize = "64x48";
constexpr const char* kSubdivisions[] = {"surfaces", "roth",   "linked",
                                         "arnaldi",  "octree", "kaplan"};

/// The bytes of the EXR that a render of the scene writes.
std::string picture(Sandbox& sandbox, const std::string& scene, const char* size,
                    const Arguments& options) {
  Arguments arguments{"render", scene_file(scene).string(), "-o", "out.exr", "--size", size, "-q"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome o = sandbox.run(arguments);
  INFO(o.err);
  REQUIRE(o.status == 0);
  const std::string bytes = file_bytes(sandbox / "out.exr");
  REQUIRE_FALSE(bytes.empty());
  return bytes;
}

/// Checks that the scene's picture is that of `serial` in all of these ways.
void check_ways(const std::string& scene, const std::vector<Arguments>& ways, const char* size,
                const Arguments& also) {
  Sandbox sandbox;
  const auto with_also = [&](Arguments way) {
    way.insert(way.end(), also.begin(), also.end());
    return way;
  };
  const std::string reference = picture(sandbox, scene, size, with_also({"--algorithm", "serial"}));
  for (const Arguments& way : ways) {
    std::string name;
    for (const std::string& word : way) name += word + " ";
    INFO(scene << " with " << name);
    CHECK((picture(sandbox, scene, size, with_also(way)) == reference));
  }
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

void check_identity(const std::string& scene, const char* size = kSize,
                    const Arguments& also = {}) {
  std::vector<Arguments> ways{{"--algorithm", "serial", "--threads", "2"},
                              {"--algorithm", "auto"},
                              {"--algorithm", "macro", "-n", "4", "--threads", "2"},
                              {"--algorithm", "roth", "-n", "4", "--threads", "2"}};
  for (const char* grain : {"pixel", "line", "tile"}) {
    ways.push_back({"--algorithm", "roth", "-n", "4", "--grain", grain});
  }
  for (const char* nodes : {"1", "2", "4", "8", "16", "32"}) {
    ways.push_back({"--algorithm", "macro", "-n", nodes});
  }
  for (const char* shadows : {"horizon", "forward", "local"}) {
    ways.push_back({"--algorithm", "macro", "-n", "8", "--shadows", shadows, "--scatter", "3"});
  }
  for (const char* nodes : {"2", "16"}) {
    ways.push_back({"--algorithm", "macro", "-n", nodes, "--partition", "balanced"});
  }
  ways.push_back({"--algorithm", "macro", "-n", "4", "--flow", "blocking", "--queue", "65536"});
  for (const char* nodes : {"1", "4", "16"}) {
    ways.push_back({"--algorithm", "macro", "-n", nodes, "--sums", "tree"});
  }
  ways.push_back({"--algorithm", "macro", "-n", "8", "--sums", "tree", "--shadows", "local",
                  "--threads", "2"});
  ways.push_back({"--algorithm", "macro", "-n", "4", "--sums", "tree", "--flow", "blocking",
                  "--queue", "65536"});
  ways.push_back({"--algorithm", "roth", "-n", "8", "--sums", "tree"});
  for (const char* nodes : {"1", "4", "16"}) {
    ways.push_back({"--algorithm", "macro", "-n", nodes, "--returns", "sender"});
  }
  ways.push_back({"--algorithm", "macro", "-n", "8", "--returns", "sender", "--shadows", "forward",
                  "--partition", "regular", "--scatter", "3"});
  ways.push_back({"--algorithm", "macro", "-n", "8", "--returns", "sender", "--shadows", "local",
                  "--sums", "tree", "--threads", "2"});
  ways.push_back({"--algorithm", "macro", "-n", "4", "--returns", "sender", "--flow", "blocking",
                  "--queue", "65536"});
  for (const char* nodes : {"2", "16"})
    ways.push_back({"--algorithm", "macro", "-n", nodes, "--boundaries", "sliding"});
  check_ways(scene, ways, size, also);
}

TEST_CASE("compare renders a scene in every way and finds the same picture each time") {
  Sandbox sandbox;
  const Outcome o = sandbox.run({"compare", scene_file("mirrors.json").string(), "-n", "4",
                                 "--size", kSize, "--queue", "4", "--plot", "bars.svg", "-q"});
  INFO(o.out << o.err);
  REQUIRE(o.status == 0);
  CHECK(o.err.empty());
  for (const char* way : {"serial ", "roth pixel", "macro as in 1987",
                          "macro as in 1987, FIFO apart", "macro, horizons", "auto "}) {
    CHECK(o.out.find(way) != std::string::npos);
  }
  CHECK(o.out.find("DIFFERENT") == std::string::npos);
  CHECK(file_bytes(sandbox / "bars.svg").starts_with("<svg "));
  const Outcome json = sandbox.run(
      {"compare", scene_file("mirrors.json").string(), "-n", "2", "--size", kSize, "--json", "-q"});
  REQUIRE(json.status == 0);
  CHECK(json.out.starts_with(
      "{\"scene\":\"mirrors.json\",\"nodes\":2,\"rows\":[{\"name\":\"serial\""));
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("compare --report renders a scene with every subdivision and distribution") {
  Sandbox sandbox;
  const Outcome o = sandbox.run({"compare", scene_file("first.json").string(), "-n", "4", "--size",
                                 kSmallSize, "--report", "-q"});
  INFO(o.out << o.err);
  REQUIRE(o.status == 0);
  for (const char* distribution :
       {"serial, ", "roth, ", "macro, forward, ", "macro, ", "macro, returned, "}) {
    for (const char* subdivision : kSubdivisions) {
      CHECK(o.out.find(std::string(distribution) + subdivision + " ") != std::string::npos);
    }
  }
  CHECK(o.out.find("TESTS/RAY") != std::string::npos);
  for (const char* mesh : {"3d", "ring", "tree"})
    CHECK(o.out.find("macro, mesh " + std::string(mesh) + " ") != std::string::npos);
  CHECK(lines_of(o.out).size() == 2 + 5 * std::size(kSubdivisions) + 3);
  CHECK(o.out.find("DIFFERENT") == std::string::npos);
}

TEST_CASE("a deadlock's report, row and bars show what the nodes did until then") {
  Sandbox sandbox;
  const std::string scene = scene_file("mirrors.json").string();
  const Outcome o =
      sandbox.run({"render", scene, "--algorithm", "macro", "-n", "16", "--shadows", "forward",
                   "--flow", "blocking", "--queue", "4", "--stats", "dead.json", "-q"});
  INFO(o.err);
  REQUIRE(o.status == 1);
  CHECK(o.err.starts_with("graycube: render: --flow blocking: deadlock: node "));
  CHECK(lines_of(o.err).size() == 1);
  CHECK(sandbox.files() == std::vector<std::string>{"dead.json"});
  const auto stats = sandbox.json("dead.json");
  CHECK(stats["failed"].get<std::string>().starts_with("deadlock: node "));
  CHECK(stats["balance"]["blocked_fraction"] > 0.1);
  CHECK(stats["balance"]["blocked_fraction"] <= 1);
  CHECK(stats["wall_s"] >= stats["phases"]["render_s"]);
  REQUIRE(stats["per_node"].size() == 16);
  std::uint64_t queue_peak = 0;
  for (const auto& node : stats["per_node"]) {
    CHECK(node["pid"] > 0);
    queue_peak = std::max(queue_peak, node["queue_peak"].get<std::uint64_t>());
  }
  CHECK(queue_peak > 0);
  CHECK(queue_peak <= 4);

  const Outcome compared = sandbox.run({"compare", scene, "-n", "16", "--size", "128x128",
                                        "--queue", "4", "--json", "--plot", "bars.svg", "-q"});
  INFO(compared.err);
  REQUIRE(compared.status == 0);
  const auto rows = nlohmann::json::parse(compared.out)["rows"];
  const auto row = std::find_if(rows.begin(), rows.end(),
                                [](const auto& r) { return r["name"] == "macro as in 1987"; });
  REQUIRE(row != rows.end());
  REQUIRE((*row)["outcome"] == "deadlocked");
  CHECK((*row)["statistics"]["balance"]["blocked_fraction"] > 0.1);
  // Its bars are drawn, and the reason why there is no picture is told.
  CHECK(file_bytes(sandbox / "bars.svg").find(">deadlocked<") != std::string::npos);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("with sums along the tree nodes send light to each other") {
  Sandbox sandbox;
  for (const char* nodes : {"4", "16"}) {
    const Outcome o =
        sandbox.run({"render", scene_file("mirrors.json").string(), "--algorithm", "macro", "-n",
                     nodes, "--sums", "tree", "-o", "out.exr", "--stats", "s.json", "-q"});
    INFO(nodes << " nodes" << o.err);
    REQUIRE(o.status == 0);
    const auto stats = sandbox.json("s.json");
    CHECK(stats["choices"]["sums"] == "tree");
    CHECK(stats["messages"]["contribution_batches"] > 0);
    CHECK(stats["messages"]["sum_batches"] > 0);
    CHECK(stats["malformed_drops"] == 0);
  }
}

TEST_CASE("where light goes back to senders, nodes answer each other's rays and count them") {
  Sandbox sandbox;
  const Outcome o =
      sandbox.run({"render", scene_file("mirrors.json").string(), "--algorithm", "macro", "-n",
                   "16", "--returns", "sender", "--shadows", "forward", "--partition", "regular",
                   "-o", "out.exr", "--stats", "s.json", "-q"});
  INFO(o.err);
  REQUIRE(o.status == 0);
  const auto stats = sandbox.json("s.json");
  CHECK(stats["choices"]["returns"] == "sender");
  CHECK(stats["messages"]["answer_batches"] > 0);
  CHECK(stats["malformed_drops"] == 0);
  std::uint64_t rays_in = 0, answers = 0;
  for (const auto& node : stats["per_node"]) {
    rays_in += node["rays_in"].get<std::uint64_t>();
    answers += node["answers"].get<std::uint64_t>();
  }
  CHECK(answers > 0);
  CHECK(answers == rays_in);
}

TEST_CASE("simulate forwards the very rays of a real render, and finds the same picture") {
  Sandbox sandbox;
  const std::vector<std::string> way{scene_file("mirrors.json").string(),
                                     "--algorithm",
                                     "macro",
                                     "--shadows",
                                     "forward",
                                     "--partition",
                                     "regular",
                                     "--size",
                                     kSize};
  const auto with = [&](std::string command, std::vector<std::string> more) {
    std::vector<std::string> arguments{std::move(command)};
    arguments.insert(arguments.end(), way.begin(), way.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sandbox.run(arguments);
  };
  REQUIRE(with("render", {"-n", "4", "-o", "a.exr", "--stats", "a.json", "-q"}).status == 0);
  const Outcome o = with("simulate", {"-n", "4,16", "--json", "-q", "--plot", "bars.svg"});
  INFO(o.err);
  REQUIRE(o.status == 0);
  const auto simulated = nlohmann::json::parse(o.out);
  REQUIRE(simulated["rows"].size() == 2);
  for (const auto& row : simulated["rows"]) {
    CHECK(row["outcome"] == "same");
    CHECK(row["time_s"] > 0);
  }
  const auto real = sandbox.json("a.json"), &row = simulated["rows"][0]["statistics"];
  CHECK(row["forwarded"] == real["forwarded"]);
  CHECK(row["rays"] == real["rays"]);
  CHECK(file_bytes(sandbox / "bars.svg").starts_with("<svg "));
  const Outcome table = with("simulate", {"-n", "2", "--flow", "blocking", "--queue", "2", "-q"});
  CHECK(table.status == 0);
  CHECK(table.out.starts_with("NODES  TIME s"));
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("a picture does not show which subdivision found its crossings") {
  const Arguments algorithms[] = {{"--algorithm", "serial"},
                                  {"--algorithm", "roth", "-n", "4"},
                                  {"--algorithm", "macro", "-n", "1"},
                                  {"--algorithm", "macro", "-n", "8", "--returns", "sender"},
                                  {"--algorithm", "macro", "-n", "16", "--shadows", "forward"}};
  for (const char* scene : {"mirrors.json", "glass.json", "tori.json", "first.json", "ortho.json",
                            "scatter1000.json", "spheres.json"}) {
    std::vector<Arguments> ways;
    for (const Arguments& algorithm : algorithms) {
      const auto add = [&](const Arguments& options) {
        ways.push_back(algorithm);
        ways.back().insert(ways.back().end(), options.begin(), options.end());
      };
      for (const char* subdivision : kSubdivisions) add({"--subdivision", subdivision});
      add({"--subdivision", "linked", "--entry", "extremal"});
      add({"--subdivision", "arnaldi", "--entry", "descent"});
    }
    check_ways(scene, ways, kSmallSize, {});
  }
}

TEST_CASE("a picture does not show which mesh the nodes formed") {
  for (const char* scene : {"mirrors.json", "glass.json", "tori.json", "first.json", "ortho.json",
                            "scatter1000.json"}) {
    std::vector<Arguments> ways;
    const auto add = [&](const char* mesh, const char* nodes, const Arguments& options = {}) {
      ways.push_back({"--algorithm", "macro", "--mesh", mesh, "-n", nodes});
      ways.back().insert(ways.back().end(), options.begin(), options.end());
    };
    for (const char* mesh : {"3d", "ring", "tree"}) {
      for (const char* nodes : {"1", "2", "4", "8", "16"}) add(mesh, nodes);
      add(mesh, "8", {"--shadows", "forward", "--partition", "regular", "--scatter", "2"});
      add(mesh, "16", {"--returns", "sender", "--shadows", "forward"});
    }
    add("3d", "16", {"--partition", "balanced", "--sums", "tree", "--threads", "2"});
    add("3d", "8", {"--shadows", "local"});
    add("3d", "8", {"--flow", "blocking", "--queue", "65536"});
    for (const char* subdivision : kSubdivisions) add("3d", "8", {"--subdivision", subdivision});
    check_ways(scene, ways, kSmallSize, {});
  }
}

TEST_CASE("statistics tell the mesh, and what its distribution took") {
  Sandbox sandbox;
  for (const char* mesh : {"2d", "3d", "ring", "tree"}) {
    picture(sandbox, "mirrors.json", kSmallSize,
            {"--algorithm", "macro", "-n", "8", "--shadows", "forward", "--mesh", mesh, "--stats",
             "stats.json"});
    const auto stats = sandbox.json("stats.json");
    INFO(mesh);
    CHECK(stats["choices"]["mesh"] == mesh);
    const bool is_3d = mesh == std::string("3d");
    CHECK(stats["grid"].size() == (is_3d ? 3 : 2));
    CHECK((stats["forwarded"]["primary"] > 0) == is_3d);
    const bool over_links = mesh == std::string("ring") || mesh == std::string("tree");
    CHECK(stats["distribution"]["slices"] == 8);
    CHECK(stats["distribution"]["slice_bytes"] > 0);
    CHECK((stats["distribution"]["link_batches"] > 0) == over_links);
    CHECK((stats["messages"]["sum_batches"] > 0) == over_links);
    CHECK(stats["malformed_drops"] == 0);
  }
}

TEST_CASE("statistics tell the subdivision, and what its search did") {
  Sandbox sandbox;
  for (const char* algorithm : {"serial", "roth", "macro"}) {
    for (const char* subdivision : kSubdivisions) {
      picture(sandbox, "mirrors.json", kSmallSize,
              {"--algorithm", algorithm, "--subdivision", subdivision, "--stats", "stats.json"});
      const auto found = sandbox.json("stats.json")["subdivision"];
      INFO(algorithm << ' ' << subdivision);
      CHECK(found["way"] == subdivision);
      CHECK(found["primitives_tested"] > 1000);
      CHECK((found["boxes_tested"] > 0) == (found["way"] == "roth"));
      CHECK((found["entry_links"] > 0) == (found["way"] == "arnaldi"));
    }
  }
}

TEST_CASE("mirrors look the same whatever computes them") { check_identity("mirrors.json"); }
TEST_CASE("glass looks the same whatever computes it") { check_identity("glass.json", kSmallSize); }
TEST_CASE("rough metal and glass that dims light look the same whatever computes them") {
  check_identity("spheres.json", kSmallSize);
}
TEST_CASE("AOVs are the same whatever computes them") {
  check_identity("first.json", kSize, {"--aov", "depth,normal,albedo,object"});
}
TEST_CASE("tori look the same whatever computes them") { check_identity("tori.json"); }
TEST_CASE("meshes look the same whatever computes them") {
  check_identity("meshes.json", kSize, {"--aov", "depth,normal,albedo,object"});
}

/// Checks that a model is rendered as it is imported, on few nodes and on many.
void check_model(const std::string& model) {
  std::vector<Arguments> ways;
  for (const char* algorithm : {"roth", "macro"}) {
    for (const char* nodes : {"1", "4", "16"})
      ways.push_back({"--algorithm", algorithm, "-n", nodes});
  }
  check_ways(model, ways, kSize, {"--aov", "depth,normal,albedo,object"});
}
TEST_CASE("each solid that is read from BRL-CAD looks the same whatever computes it") {
  Sandbox sandbox;
  // A solid that isn't read would be told of, as the region of air is.
  const Outcome o = sandbox.run({"check", scene_file("brlcad/solids.asc").string()});
  CHECK(o.err == "graycube: warning: " + scene_file("brlcad/solids.asc").string() +
                     ": 1 air region is left out: air.r\n");
  CHECK(o.out.find("27 objects") != std::string::npos);
  check_model("brlcad/solids.asc");
}
TEST_CASE("a model from OpenSCAD looks the same whatever computes it") {
  check_model("openscad/bracket.csg");
}
TEST_CASE("solids that repeat themselves look the same whatever computes them") {
  for (const char* scene : {"sponge.json", "tetrahedra.json", "tree.json"}) check_model(scene);
}
TEST_CASE("solids of Bézier patches look the same whatever computes them") {
  check_model("pot.json");
}
TEST_CASE("outlines that are turned and swept look the same whatever computes them") {
  check_identity("vase.json", kSmallSize, {"--aov", "depth,normal,albedo,object"});
}
TEST_CASE("a scene on an endless floor looks the same whatever computes it") {
  check_identity("first.json");
}
TEST_CASE("an orthographic picture is the same whatever computes it") {
  check_identity("ortho.json");
}

TEST_CASE("a picture does not show which vector instructions computed it") {
  Sandbox sandbox;
  for (const char* scene : {"first.json", "glass.json", "mirrors.json", "tori.json", "meshes.json",
                            "spheres.json", "vase.json"}) {
    std::string reference;
    for (const std::string& name : simd_names()) {
      INFO(scene << " with " << name);
      ::setenv("GRAYCUBE_SIMD", name.c_str(), 1);
      const std::string serial = picture(sandbox, scene, kSmallSize, {"--algorithm", "serial"});
      const std::string macro =
          picture(sandbox, scene, kSmallSize, {"--algorithm", "macro", "-n", "4"});
      ::unsetenv("GRAYCUBE_SIMD");
      if (reference.empty()) reference = serial;
      CHECK((serial == reference));
      CHECK((macro == reference));
    }
  }
}
TEST_CASE("vector instructions that the machine doesn't have are refused") {
  Sandbox sandbox;
  ::setenv("GRAYCUBE_SIMD", "mmx", 1);
  const Outcome o = sandbox.run({"render", scene_file("first.json").string(), "-q"});
  ::unsetenv("GRAYCUBE_SIMD");
  CHECK(o.status == 2);
  CHECK(o.err.find("graycube: environment: GRAYCUBE_SIMD: mmx: this machine has best, scalar") ==
        0);
}

}  // namespace
}  // namespace graycube

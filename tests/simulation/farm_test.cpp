#include "simulation/random_machine.hpp"

#include <set>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "proto/model_slice.hpp"
#include "scene/compile_scene.hpp"
#include "simulation/pictures.hpp"

using namespace graycube;
using namespace graycube::simulation;

TEST_CASE("macro gives the serial picture on 1 to 64 nodes, whatever the links' delays") {
  const std::string text = scene_text(36, 24);
  const Picture expected = serial_picture(text);
  for (std::uint64_t seed = 1; seed <= 240; ++seed) {
    RandomFarmOptions options;
    options.nodes = 1u << (seed % 7);
    options.threads = static_cast<std::uint32_t>(1 + seed % 3);
    options.seed = seed;
    options.link_delay_s = seed % 2 == 0 ? 1e-3 : 1e-1;
    INFO("seed " << seed << ", " << options.nodes << " nodes");
    RandomFarm farm(options);
    check_same_picture(farm, farm.render(text, with(Algorithm::kMacro)), 1, expected);
  }
}

TEST_CASE("AOVs are the serial ones, also of rays that run along the macro-regions' boundaries") {
  std::string text = scene_text(32, 32);
  const std::string camera = "\"fov\": 60";
  for (const char* offset : {"[0.5,0.5]", "[0,0]", "[1,0.25]"}) {
    for (const char* projection : {"perspective", "orthographic"}) {
      std::string own = text;
      const bool is_parallel = projection[0] == 'o';
      own.replace(own.find("perspective"), 11, projection);
      own.replace(own.find(camera), camera.size(),
                  (is_parallel ? std::string("\"width\": 9, \"inside\": \"entry\"") : camera) +
                      ", \"pixel_offset\": " + offset);
      if (is_parallel) own.replace(own.find("[0,3,-9]"), 8, "[0,1,-2]");
      own.replace(own.find("\"height\": 32"), 12, "\"height\": 32, \"samples\": 2");
      const Picture expected = serial_picture(own, AovSet::all());
      for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        RandomFarmOptions options;
        options.nodes = 1u << (seed % 5);
        options.seed = seed;
        INFO(offset << " " << projection << ", seed " << seed << ", " << options.nodes << " nodes");
        RandomFarm farm(options);
        control::JobOptions job = with(seed % 3 == 0 ? Algorithm::kRoth : Algorithm::kMacro);
        job.aov = "depth,normal,albedo,object";
        check_same_picture(farm, farm.render(own, job), 1, expected);
      }
    }
  }
}

TEST_CASE("a job that asks for unknown AOVs is refused") {
  RandomFarm farm({.nodes = 2, .seed = 3});
  control::JobOptions job = with(Algorithm::kMacro);
  job.aov = "depth,colour";
  const Outcome outcome = farm.render(scene_text(16, 16), job);
  REQUIRE(outcome.failed);
  CHECK(outcome.failed->errors.front().where == "--aov");
}

TEST_CASE("roth gives the serial picture for every grain") {
  const std::string text = scene_text(30, 20);
  const Picture expected = serial_picture(text);
  std::uint64_t seed = 1000;
  for (const Grain grain : {Grain::kPixel, Grain::kLine, Grain::kTile}) {
    for (const std::uint32_t nodes : {1u, 2u, 8u, 16u}) {
      INFO("seed " << seed << ", " << nodes << " nodes");
      RandomFarm farm({.nodes = nodes, .threads = 2, .seed = seed++});
      check_same_picture(farm, farm.render(text, with(Algorithm::kRoth, grain)), 1, expected);
    }
  }
}

TEST_CASE("a farm renders one job after another") {
  RandomFarm farm({.nodes = 8, .seed = 5});
  std::uint32_t job = 0;
  for (const unsigned width : {16u, 40u, 24u}) {
    const std::string text = scene_text(width, 16);
    const auto algorithm = width == 40 ? Algorithm::kRoth : Algorithm::kMacro;
    check_same_picture(farm, farm.render(text, with(algorithm)), ++job, serial_picture(text));
  }
}

TEST_CASE("a farm whose nodes can't be started gives up, and says why") {
  const auto store = make_memory_store();
  FrontalOptions options{.cube = *Hypercube::of_size(2), .version = "simulated"};
  Frontal frontal(options, *store);
  unsigned started = 0;
  for (int round = 0; round < 100 && !frontal.is_going_down(); ++round) {
    for (const Frontal::Process& p : frontal.take_starts()) {
      ++started;
      frontal.on_node_exit(p, "exited with status 1");
    }
  }
  CHECK(frontal.is_going_down());
  CHECK(frontal.fatal_error().find("exited with status 1") != std::string::npos);
  CHECK(started <= kMaxFailedStarts + 2);
}

TEST_CASE("a farm that has never been whole gives nobody a host, and says why it gives up") {
  const auto store = make_memory_store();
  Frontal frontal({.cube = *Hypercube::of_size(2), .version = "simulated"}, *store);
  const Frontal::Process here = frontal.take_starts().front();
  frontal.on_message("a", Message::of_text(encode(control::Hello{
                              here.rank.value, 1, here.incarnation, "ipc://a", 1, "simulated"})));
  Frontal::Process other{Rank{1}, here.incarnation + 1};
  for (unsigned i = 0; i < kMaxFailedStarts; ++i) {
    REQUIRE_FALSE(frontal.is_going_down());
    frontal.on_start_failure(other, "too many processes");
    for (const Frontal::Process& p : frontal.take_starts()) other = p;
  }
  CHECK(frontal.is_going_down());
  CHECK(frontal.take_hostings().empty());
  CHECK(frontal.fatal_error() ==
        "node 1: can't be started: too many processes; its process couldn't be started 8 times in "
        "a row");
}

TEST_CASE("a scene with mistakes fails with all of them") {
  RandomFarm farm({.nodes = 2, .seed = 9});
  const Outcome outcome = farm.render(R"({"graycube": 1, "objects": 3})", with(Algorithm::kMacro));
  REQUIRE(outcome.failed);
  CHECK(outcome.failed->code == FailureCode::kBadInput);
  CHECK(outcome.failed->errors.size() >= 3);
}

TEST_CASE("a farm that anybody may submit to takes no compiled scene") {
  const Bytes compiled = encode_model(compile_scene(*read_scene_text(scene_text(36, 24)).scene));
  RandomFarm farm({.nodes = 2});
  const Outcome outcome = farm.render(
      {reinterpret_cast<const char*>(compiled.data()), compiled.size()}, with(Algorithm::kMacro));
  REQUIRE(outcome.failed);
  CHECK(outcome.failed->code == FailureCode::kBadInput);
  CHECK(outcome.failed->errors.front().why ==
        "this farm compiles scenes itself: expected JSON or CBOR");
}

// What `auto` decides.
#include "frontal/preparation/choice.hpp"

#include "catch.hpp"

using namespace graycube;

namespace {

constexpr ChoiceBasis kSmall{.model_bytes = 300'000, .primary_rays = 512 * 512, .nodes = 64};

ChoiceBasis on_hosts(std::uint32_t hosts, ChoiceBasis basis = kSmall) {
  basis.hosts = hosts;
  return basis;
}

}  // namespace

TEST_CASE("on one host auto is roth as long as a copy of the scene is small") {
  CHECK(chosen_algorithm(MeshMode::k2d, kSmall) == Algorithm::kRoth);
  ChoiceBasis basis = kSmall;
  basis.model_bytes = kReplicatedModelBytes;
  CHECK(chosen_algorithm(MeshMode::k2d, basis) == Algorithm::kRoth);
  ++basis.model_bytes;
  CHECK(chosen_algorithm(MeshMode::k2d, basis) == Algorithm::kMacro);
}

TEST_CASE("a mesh that is asked for makes auto macro, whatever the hosts") {
  for (const MeshMode mesh : {MeshMode::k3d, MeshMode::kRing, MeshMode::kTree}) {
    CHECK(chosen_algorithm(mesh, kSmall) == Algorithm::kMacro);
    CHECK(chosen_algorithm(mesh, on_hosts(8)) == Algorithm::kMacro);
  }
}

TEST_CASE("on several hosts auto is macro where copying takes longer than roth can gain") {
  CHECK(chosen_algorithm(MeshMode::k2d, on_hosts(8)) == Algorithm::kMacro);
  ChoiceBasis tiny = kSmall;
  tiny.model_bytes = 2'000;
  CHECK(chosen_algorithm(MeshMode::k2d, on_hosts(8, tiny)) == Algorithm::kRoth);
  ChoiceBasis long_render = kSmall;
  long_render.primary_rays *= 1000;
  CHECK(chosen_algorithm(MeshMode::k2d, on_hosts(8, long_render)) == Algorithm::kRoth);
  // Few nodes get few copies, and each has more to do meanwhile.
  ChoiceBasis few = kSmall;
  few.nodes = 4;
  CHECK(chosen_algorithm(MeshMode::k2d, on_hosts(4, few)) == Algorithm::kRoth);
}

TEST_CASE("copies take time for each node's bytes, but none on one host") {
  CHECK(copying_s(kSmall) == 0);
  const double few_s = copying_s(on_hosts(2));
  CHECK(few_s > 0);
  ChoiceBasis more = on_hosts(2);
  more.nodes *= 2;
  CHECK(copying_s(more) == Approx(2 * few_s));
}

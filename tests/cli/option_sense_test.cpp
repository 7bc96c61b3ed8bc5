#include "cli/option_sense.hpp"

#include "cli/expect_failure.hpp"

namespace graycube {
namespace {

TEST_CASE("an option that the algorithm has no use for is refused, and no other") {
  control::JobOptions o;
  o.grain = Grain::kPixel;
  CHECK_NOTHROW(check_sense(o));  // auto may be roth
  o.algorithm = Algorithm::kRoth;
  CHECK_NOTHROW(check_sense(o));
  o.algorithm = Algorithm::kMacro;
  CHECK(refusal([&] { check_sense(o); }) ==
        "graycube: usage: --grain: is for --algorithm roth, not for macro");
  o = {};
  o.shadows = ShadowMode::kLocal;
  o.algorithm = Algorithm::kMacro;
  CHECK_NOTHROW(check_sense(o));
  o.algorithm = Algorithm::kRoth;
  CHECK(refusal([&] { check_sense(o); }) ==
        "graycube: usage: --shadows: is for --algorithm macro, not for roth");
  o = {};
  o.sums = SumsMode::kTree;
  o.algorithm = Algorithm::kSerial;
  CHECK(refusal([&] { check_sense(o); }) ==
        "graycube: usage: --sums: is for --algorithm roth and macro, not for serial");
  o = {};
  o.returns = ReturnsMode::kSender;
  CHECK_NOTHROW(check_sense(o));
  o.algorithm = Algorithm::kRoth;
  CHECK(refusal([&] { check_sense(o); }) ==
        "graycube: usage: --returns: is for --algorithm macro, not for roth");
}

TEST_CASE("boundaries slide only where nodes hold what their own macro-region needs") {
  control::JobOptions o;
  o.boundaries = BoundariesMode::kSliding;
  CHECK_NOTHROW(check_sense(o));
  o.algorithm = Algorithm::kRoth;
  CHECK(refusal([&] { check_sense(o); }) ==
        "graycube: usage: --boundaries: is for --algorithm macro, not for roth");
  o.algorithm = Algorithm::kMacro;
  o.shadows = ShadowMode::kLocal;
  CHECK(refusal([&] { check_sense(o); }) ==
        "graycube: usage: --boundaries: sliding goes with --shadows horizon and forward, not "
        "local");
  o.shadows = ShadowMode::kForward;
  o.scatter = 2;
  CHECK(refusal([&] { check_sense(o); }) ==
        "graycube: usage: --boundaries: sliding goes with one macro-region for each node, not with "
        "--scatter");
  o.scatter = 1;
  CHECK_NOTHROW(check_sense(o));
}

TEST_CASE("a queue's length is for blocking flow only") {
  control::JobOptions o;
  o.queue = 3;
  CHECK(refusal([&] { check_sense(o); }) ==
        "graycube: usage: --queue: is for --flow blocking, which is not asked for");
  o.flow = FlowMode::kBlocking;
  CHECK_NOTHROW(check_sense(o));
}

TEST_CASE("an entry can be chosen only where leaf regions are linked") {
  control::JobOptions o;
  o.subdivision = {Subdivision::kOctree, Entry::kDescent};
  CHECK(refusal([&] { check_sense(o); }) ==
        "graycube: usage: --entry: is for --subdivision linked and arnaldi, not for octree");
  o.subdivision.way = Subdivision::kArnaldi;
  CHECK_NOTHROW(check_sense(o));
}

}  // namespace
}  // namespace graycube

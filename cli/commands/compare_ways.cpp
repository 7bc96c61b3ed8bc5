#include "cli/commands/compare_ways.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "cli/option_values.hpp"

namespace graycube {

std::vector<Way> ways_of_algorithms(const control::JobOptions& common) {
  std::vector<Way> ways;
  const auto add = [&](std::string name, std::string arguments, auto&& set) {
    Way way{std::move(name), std::move(arguments), common};
    set(way.options);
    ways.push_back(std::move(way));
  };
  for (const Grain grain : {Grain::kPixel, Grain::kLine, Grain::kTile}) {
    const std::string name(to_string(grain));
    add("roth " + name, "--algorithm roth --grain " + name, [&](auto& o) {
      o.algorithm = Algorithm::kRoth;
      o.grain = grain;
    });
  }
  struct Macro {
    ShadowMode shadows = ShadowMode::kForward;
    std::uint32_t scatter = 1;
    PartitionMode partition = PartitionMode::kRegular;
    /// Places of a blocking queue; 0 for flow by credit.
    std::uint32_t queue = 0;
    FifoMode fifo = FifoMode::kThread;
  };
  const auto macro = [&](std::string name, const Macro& m) {
    std::string arguments = "--algorithm macro --shadows " + std::string(to_string(m.shadows)) +
                            " --scatter " + std::to_string(m.scatter) + " --partition " +
                            std::string(to_string(m.partition));
    if (m.queue != 0) arguments += " --flow blocking --queue " + std::to_string(m.queue);
    if (m.fifo == FifoMode::kProcess) arguments += " --fifo process";
    add(std::move(name), std::move(arguments), [&](auto& o) {
      o.algorithm = Algorithm::kMacro;
      o.shadows = m.shadows;
      o.scatter = m.scatter;
      o.partition = m.partition;
      o.flow = m.queue != 0 ? FlowMode::kBlocking : FlowMode::kCredit;
      if (m.queue != 0) o.queue = m.queue;
      o.fifo = m.fifo;
    });
  };
  macro("macro as in 1987", {.queue = common.queue});
  macro("  with endless queues", {.queue = kMaxQueue});
  macro("macro as in 1987, FIFO apart", {.queue = common.queue, .fifo = FifoMode::kProcess});
  macro("macro, credits", {});
  macro("macro, horizons", {.shadows = ShadowMode::kHorizon});
  macro("macro, local shadows", {.shadows = ShadowMode::kLocal});
  macro("macro, scatter 2", {.scatter = 2});
  macro("macro, balance", {.partition = PartitionMode::kBalanced});
  macro("macro, all", {.shadows = ShadowMode::kHorizon, .partition = PartitionMode::kAuto});
  add("auto", "--algorithm auto", [](auto& o) { o.algorithm = Algorithm::kAuto; });
  return ways;
}

namespace {

/// How work and space are shared out.
struct Distribution {
  std::string_view name, arguments;
  Algorithm algorithm;
  ShadowMode shadows = ShadowMode::kHorizon;
  std::uint32_t scatter = 0;
  PartitionMode partition = PartitionMode::kAuto;
  ReturnsMode returns = ReturnsMode::kFrontal;
};

constexpr std::array kDistributions{
    Distribution{"serial", "--algorithm serial", Algorithm::kSerial},
    Distribution{"roth", "--algorithm roth", Algorithm::kRoth},
    Distribution{"macro, forward",
                 "--algorithm macro --shadows forward --scatter 1 --partition regular",
                 Algorithm::kMacro, ShadowMode::kForward, 1, PartitionMode::kRegular},
    Distribution{"macro", "--algorithm macro", Algorithm::kMacro},
    Distribution{"macro, returned", "--algorithm macro --returns sender", Algorithm::kMacro,
                 ShadowMode::kHorizon, 0, PartitionMode::kAuto, ReturnsMode::kSender},
};

}  // namespace

std::vector<Way> ways_of_report(const control::JobOptions& common) {
  std::vector<Way> ways;
  for (const Distribution& d : kDistributions) {
    for (const Subdivision subdivision : kSubdivisionChoices) {
      const std::string name(to_string(subdivision));
      Way way{std::string(d.name) + ", " + name,
              std::string(d.arguments) + " --subdivision " + name, common};
      way.options.algorithm = d.algorithm;
      way.options.shadows = d.shadows;
      way.options.scatter = d.scatter;
      way.options.partition = d.partition;
      way.options.returns = d.returns;
      way.options.subdivision.way = subdivision;
      ways.push_back(std::move(way));
    }
  }
  for (const MeshMode mesh : {MeshMode::k3d, MeshMode::kRing, MeshMode::kTree}) {
    const std::string name(to_string(mesh));
    Way way{"macro, mesh " + name, "--algorithm macro --mesh " + name, common};
    way.options.algorithm = Algorithm::kMacro;
    way.options.mesh = mesh;
    ways.push_back(std::move(way));
  }
  return ways;
}

}  // namespace graycube

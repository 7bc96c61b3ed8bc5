#include "cli/option_sense.hpp"

#include <array>
#include <string>

#include "cli/failure.hpp"

namespace graycube {
namespace {

/// An option that is given, and what it is for.
struct Use {
  const char* name;
  bool is_given;
  bool is_for_roth, is_for_macro;
};

void check_sliding(const control::JobOptions& o) {
  if (o.shadows == ShadowMode::kLocal)
    throw usage_failure("--boundaries",
                        "sliding goes with --shadows horizon and forward, not local");
  if (o.scatter > 1)
    throw usage_failure("--boundaries",
                        "sliding goes with one macro-region for each node, not with --scatter");
}

}  // namespace

void check_sense(const control::JobOptions& o) {
  const control::JobOptions usual;
  const std::array<Use, 8> uses{{
      {"--grain", o.grain != usual.grain, true, false},
      {"--shadows", o.shadows != usual.shadows, false, true},
      {"--partition", o.partition != usual.partition, false, true},
      {"--scatter", o.scatter != usual.scatter, false, true},
      {"--flow", o.flow != usual.flow, true, true},
      {"--sums", o.sums != usual.sums, true, true},
      {"--returns", o.returns != usual.returns, false, true},
      {"--boundaries", o.boundaries != usual.boundaries, false, true},
  }};
  const bool is_auto = o.algorithm == Algorithm::kAuto;
  for (const Use& use : uses) {
    const bool applies = is_auto || (use.is_for_roth && o.algorithm == Algorithm::kRoth) ||
                         (use.is_for_macro && o.algorithm == Algorithm::kMacro);
    if (!use.is_given || applies) continue;
    const std::string users = !use.is_for_macro  ? "roth"
                              : !use.is_for_roth ? "macro"
                                                 : "roth and macro";
    throw usage_failure(use.name, "is for --algorithm " + users + ", not for " +
                                      std::string(to_string(o.algorithm)));
  }
  if (o.subdivision.entry != Entry::kUsual && !has_links(o.subdivision.way))
    throw usage_failure("--entry", "is for --subdivision linked and arnaldi, not for " +
                                       std::string(to_string(o.subdivision.way)));
  if (o.boundaries == BoundariesMode::kSliding) check_sliding(o);
  if (o.queue != usual.queue && o.flow != FlowMode::kBlocking)
    throw usage_failure("--queue", "is for --flow blocking, which is not asked for");
}

}  // namespace graycube

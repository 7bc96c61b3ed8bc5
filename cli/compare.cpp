// graycube compare: one scene with every algorithm, in one table.
#include "cli/commands.hpp"

namespace graycube {

ExitStatus run(const CompareCommand&) { throw usage_failure("compare", "not built yet"); }

}  // namespace graycube

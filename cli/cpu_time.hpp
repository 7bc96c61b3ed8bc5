#pragma once

namespace graycube {

/// User and system seconds that this process has used so far, all its threads together.
double own_cpu_seconds();

}  // namespace graycube

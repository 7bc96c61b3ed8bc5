// A folder for temporary files, or an error that says which folder can't have one.
#pragma once

#include <cstdlib>
#include <string>
#include <system_error>

#include "cli/failure.hpp"
#include "process/temporary_folder.hpp"

namespace graycube {

/// Throws a Failure of status 2 that names $TMPDIR when no temporary files can be made there.
inline void check_temporary_place() {
  try {
    const TemporaryFolder probe;
  } catch (const std::system_error& error) {
    const char* variable = std::getenv("TMPDIR");
    const std::string folder = variable != nullptr ? variable : "/tmp";
    throw Failure(ExitStatus::kBadInput, Problem{"environment", "TMPDIR",
                                                 "no temporary files can be made in " + folder +
                                                     ": " + error.code().message()});
  }
}

}  // namespace graycube

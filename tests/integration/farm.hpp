// A farm in one terminal, for the tests of its users.
#pragma once

#include <string>

#include "integration/sandbox.hpp"

namespace graycube {

/// `graycube up` with four nodes, once it listens; killed at the end if it still runs then.
class Farm {
 public:
  explicit Farm(Sandbox& sandbox, const Arguments& options = {});

  Running& up() { return up_; }

 private:
  Running up_;
};

/// Runs a command that must succeed; returns its output.
std::string ok(Sandbox& sandbox, const Arguments& arguments);

/// The job's id as submit prints it: alone on its line.
std::string submit(Sandbox& sandbox, Arguments options);

/// Fails the test unless the job gets into that state within half a minute.
void wait_for_state(Sandbox& sandbox, const std::string& job, const std::string& state);

}  // namespace graycube

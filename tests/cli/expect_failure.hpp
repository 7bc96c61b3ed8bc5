// The lines of the failures that functions of the command throw.
#pragma once

#include <string>

#include "catch.hpp"
#include "cli/failure.hpp"

namespace graycube {

/// The first line of the failure that `act` throws; its status must be that of bad usage or input.
template <typename Act>
std::string refusal(const Act& act) {
  try {
    act();
  } catch (const Failure& failure) {
    CHECK(failure.status() == ExitStatus::kBadInput);
    REQUIRE_FALSE(failure.problems().empty());
    return line_of(failure.problems().front());
  }
  FAIL("nothing was refused");
  return {};
}

}  // namespace graycube

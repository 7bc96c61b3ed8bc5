// The failures that functions of the command throw, as their lines.
#pragma once

#include <string>

#include "catch.hpp"
#include "cli/failure.hpp"

namespace graycube {

/// The first line of what `act` throws, which must have the status of bad usage or input.
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

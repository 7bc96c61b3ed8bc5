// Where a farm is, and what opens its door.
#pragma once

#include <string>
#include <utility>

namespace graycube {

struct FarmAddress {
  std::string endpoint;
  /// The file of the farm's key; empty for where a farm at that endpoint leaves it.
  std::string key_file;

  FarmAddress() = default;
  FarmAddress(std::string at, std::string key = "")  // NOLINT: implicit
      : endpoint(std::move(at)), key_file(std::move(key)) {}
};

/// Fills in what the user didn't say: where the environment, or else habit, has the farm; and where
/// the farm of a job of Slurm is ("slurm:25"). Throws a usage failure, or that of a farm that isn't
/// there.
void resolve(FarmAddress& farm);

}  // namespace graycube

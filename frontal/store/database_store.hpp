// The job store of a daemon: a folder with a database of jobs (jobs.sqlite) and a file for each
// picture. What was accepted is there again after any end of the process or the machine.
#pragma once

#include <filesystem>
#include <memory>

#include "frontal/parts/job_store.hpp"
#include "frontal/store/set_aside.hpp"
#include "keep_rule.hpp"

namespace graycube {

struct StoreOptions {
  KeepRule keep{};
  /// Jobs needn't outlive the machine's end, only the process's: nobody waits for the disk.
  bool is_passing = false;
};

/// The folder is made when it isn't there. A database that is damaged is set aside as a whole, and
/// another begun, whose numbers lie beyond those of all pictures. Throws std::runtime_error when
/// the folder can't be used, or another process uses it.
std::unique_ptr<JobStore> open_database_store(const std::filesystem::path& folder,
                                              const StoreOptions& options, Warn warn);

}  // namespace graycube

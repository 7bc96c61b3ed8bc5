// The job store of `graycube render --checkpoint`: one job, whose tiles are recorded in a file.
#pragma once

#include <filesystem>
#include <memory>

#include "frontal/parts/job_store.hpp"
#include "frontal/store/set_aside.hpp"

namespace graycube {

/// Everything but tiles is in memory. The file stays when the job ends: the command removes it once
/// the picture is written.
std::unique_ptr<JobStore> make_checkpoint_store(const std::filesystem::path& file, Warn warn);

}  // namespace graycube

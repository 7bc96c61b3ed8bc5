// The hosts that Slurm has given to the job in which this command runs.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace graycube {

struct Allocation {
  /// Slurm's number of the job.
  std::string job;
  struct Host {
    std::string name;
    std::uint32_t cpus = 1;
  };
  std::vector<Host> hosts;

  std::uint32_t cpus() const;
};

/// The CPUs of each host, in order, from the text of SLURM_JOB_CPUS_PER_NODE: "4(x2),2" is 4, 4, 2.
/// Nothing if it is no such text.
std::optional<std::vector<std::uint32_t>> cpus_of_hosts(std::string_view text);

/// The allocation that the environment tells of; nothing outside of one. Throws a Failure when its
/// hosts can't be found out.
std::optional<Allocation> find_allocation();

/// Nodes of each host so that `nodes` find room: the same power of two for all.
std::uint32_t slots_of_each(const Allocation& allocation, std::uint32_t nodes);

/// This machine's address as the allocation's hosts reach it; a loopback address where this is the
/// only one. Throws a Failure when no host can be found.
std::string address_in(const Allocation& allocation);

/// Where the farm of a job leaves its endpoint and key for this user's other commands.
struct FarmFiles {
  std::string endpoint, key;
};
FarmFiles farm_files(const std::string& job);
/// Makes their folder, which this user alone may enter. Throws a Failure.
void make_farm_folder(const FarmFiles& files);
/// Writes the endpoint into its file, readable by this user alone. Throws a Failure.
void write_farm_endpoint(const FarmFiles& files, const std::string& endpoint);
void remove_farm_files(const FarmFiles& files) noexcept;
/// The endpoint that the farm of a job has left. Throws a Failure when there is none.
std::string read_farm_endpoint(const std::string& job);

}  // namespace graycube

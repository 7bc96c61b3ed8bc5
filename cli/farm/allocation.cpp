#include "cli/farm/allocation.hpp"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "cli/failure.hpp"
#include "host/machine.hpp"
#include "process/command_output.hpp"
#include "topology/hypercube.hpp"
#include "transport/farm_key.hpp"
#include "transport/own_address.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostHosts = kMaxNodes;
/// Any port: only the address is asked for.
constexpr const char* kAnyPort = ":1";

Failure slurm_failure(const std::string& where, const std::string& why) {
  return {ExitStatus::kFailed, Problem{"slurm", where, why}};
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::optional<std::uint32_t> count_of(std::string_view text) {
  std::uint32_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count == 0) return std::nullopt;
  return count;
}

/// Slurm's own tool knows how lists of hosts are abbreviated.
std::vector<std::string> host_names(const std::string& list) {
  CommandOutput output;
  try {
    output = command_output({"scontrol", "show", "hostnames", list});
  } catch (const std::system_error& e) {
    throw slurm_failure("scontrol", std::string("can't be run: ") + e.code().message());
  }
  if (output.wait_status != 0) throw slurm_failure("scontrol show hostnames " + list, "failed");
  std::vector<std::string> names;
  std::istringstream lines(output.text);
  for (std::string name; lines >> name;) names.push_back(name);
  if (names.empty() || names.size() > kMostHosts) {
    throw slurm_failure("scontrol show hostnames " + list,
                        "expected 1 to " + std::to_string(kMostHosts) + " hosts");
  }
  return names;
}

bool is_job_number(std::string_view text) {
  return !text.empty() && text.size() <= 20 &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

std::uint32_t Allocation::cpus() const {
  std::uint64_t sum = 0;
  for (const Host& host : hosts) sum += host.cpus;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(sum, kMaxNodes));
}

std::optional<std::vector<std::uint32_t>> cpus_of_hosts(std::string_view text) {
  std::vector<std::uint32_t> cpus;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    if (end + 1 == text.size()) return std::nullopt;  // a comma, and nothing behind it
    std::string_view item = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    std::uint32_t times = 1;
    if (const std::size_t bracket = item.find("(x"); bracket != item.npos) {
      if (!item.ends_with(')')) return std::nullopt;
      const auto repeated = count_of(item.substr(bracket + 2, item.size() - bracket - 3));
      if (!repeated || *repeated > kMostHosts) return std::nullopt;
      times = *repeated;
      item = item.substr(0, bracket);
    }
    const auto each = count_of(item);
    if (!each || cpus.size() + times > kMostHosts) return std::nullopt;
    cpus.insert(cpus.end(), times, *each);
  }
  if (cpus.empty()) return std::nullopt;
  return cpus;
}

std::optional<Allocation> find_allocation() {
  const std::string job = variable("SLURM_JOB_ID"), list = variable("SLURM_JOB_NODELIST");
  if (job.empty() || list.empty()) return std::nullopt;
  if (!is_job_number(job)) throw slurm_failure("SLURM_JOB_ID", "expected a number: " + job);
  Allocation allocation{job, {}};
  const std::string cpus_text = variable("SLURM_JOB_CPUS_PER_NODE");
  const auto cpus = cpus_of_hosts(cpus_text);
  const std::vector<std::string> names = host_names(list);
  if (!cpus || cpus->size() != names.size()) {
    throw slurm_failure("SLURM_JOB_CPUS_PER_NODE",
                        "expected the CPUs of " + std::to_string(names.size()) +
                            " hosts, such as 4(x2),2: '" + cpus_text + "'");
  }
  for (std::size_t i = 0; i < names.size(); ++i) allocation.hosts.push_back({names[i], (*cpus)[i]});
  return allocation;
}

std::uint32_t slots_of_each(const Allocation& allocation, std::uint32_t nodes) {
  const auto hosts = static_cast<std::uint32_t>(allocation.hosts.size());
  return std::bit_ceil((nodes + hosts - 1) / hosts);
}

std::string address_in(const Allocation& allocation) {
  const std::string slurms_name = variable("SLURMD_NODENAME");
  const std::string own = slurms_name.empty() ? machine_name() : slurms_name;
  std::string why = "no host's address is known";
  for (const Allocation::Host& host : allocation.hosts) {
    if (host.name == own) continue;
    try {
      return own_address_towards("tcp://" + host.name + kAnyPort);
    } catch (const TransportError& e) {
      why = e.what();
    }
  }
  const bool is_alone = allocation.hosts.size() == 1 && allocation.hosts.front().name == own;
  if (is_alone) return "127.0.0.1";
  throw slurm_failure("hosts of job " + allocation.job, why);
}

FarmFiles farm_files(const std::string& job) {
  if (!is_job_number(job)) throw usage_failure("slurm:" + job, "expected the number of a job");
  const std::string home = variable("HOME");
  if (!home.starts_with('/')) throw slurm_failure("HOME", "expected an absolute path");
  const std::string base = home + "/.graycube/farms/" + job;
  return {base + ".endpoint", base + ".key"};
}

void make_farm_folder(const FarmFiles& files) {
  try {
    const fs::path folder = fs::path(files.endpoint).parent_path();
    make_private_folder(folder.parent_path().string());
    make_private_folder(folder.string());
  } catch (const KeyError& e) {
    throw slurm_failure("the farm's files", e.what());
  }
}

void write_farm_endpoint(const FarmFiles& files, const std::string& endpoint) {
  const std::string unfinished = files.endpoint + "." + std::to_string(::getpid());
  std::ofstream out(unfinished);
  out << endpoint << '\n';
  out.close();
  std::error_code error;
  if (out) fs::rename(unfinished, files.endpoint, error);
  if (!out || error) throw slurm_failure(files.endpoint, "can't be written");
}

void remove_farm_files(const FarmFiles& files) noexcept {
  for (const std::string* file : {&files.endpoint, &files.key}) ::unlink(file->c_str());
}

std::string read_farm_endpoint(const std::string& job) {
  const FarmFiles files = farm_files(job);
  std::string endpoint;
  if (!(std::ifstream(files.endpoint) >> endpoint)) {
    throw Failure(ExitStatus::kFailed,
                  Problem{"farm", "slurm:" + job,
                          "it has left no endpoint in " + files.endpoint +
                              "; a farm does so that 'graycube up' has started in that job"});
  }
  return endpoint;
}

}  // namespace graycube

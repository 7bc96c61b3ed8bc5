// graycube join: gives this machine to a farm, for as long as the farm runs.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>

#include "cli/commands/commands.hpp"
#include "cli/temporary_place.hpp"
#include "host/host_process.hpp"
#include "host/machine.hpp"
#include "topology/hypercube.hpp"
#include "transport/endpoint.hpp"
#include "transport/farm_key.hpp"
#include "version.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

/// The key as a launcher hands it over, which then stands in no file that others would have to
/// share. Throws KeyError.
Secret key_from_input() {
  std::string text;
  std::getline(std::cin, text);
  const auto key = secret_of_hex(text);
  if (!key) throw KeyError("standard input: expected a key of 64 hexadecimal digits");
  return *key;
}

Secret key_of(const JoinCommand& command) {
  try {
    if (command.key == "-") return key_from_input();
    return read_farm_key(command.key.empty() ? key_file_of(command.endpoint) : command.key);
  } catch (const KeyError& e) {
    throw Failure(ExitStatus::kFailed,
                  Problem{"join", command.endpoint, std::string("the farm's key: ") + e.what()});
  }
}

void check(const JoinCommand& command) {
  if (!command.endpoint.starts_with("tcp://"))
    throw usage_failure(command.endpoint, "hosts join at a TCP port: expected tcp://HOST:PORT");
  if (const auto problem = endpoint_problem(command.endpoint, !command.key.empty()))
    throw usage_failure(command.endpoint, *problem);
  if (command.name.size() > kMaxNameBytes) throw usage_failure("--name", "the name is too long");
}

}  // namespace

ExitStatus run(const JoinCommand& command) {
  check(command);
  HostSetting setting;
  setting.endpoint = command.endpoint;
  setting.keys = farm_keys_of(key_of(command));
  setting.address = command.address;
  setting.node_program =
      (fs::read_symlink("/proc/self/exe").parent_path() / "graycube-node").string();
  check_temporary_place();
  control::Join& about = setting.about;
  about.host = command.name.empty() ? machine_name() : command.name;
  about.tag = locality_tag();
  about.cores = usable_cores();
  about.memory_bytes = usable_memory_bytes();
  about.slots = command.slots != 0 ? command.slots : std::min(about.cores, kMaxNodes);
  about.pid = static_cast<std::uint64_t>(::getpid());
  about.version = kVersion;
  const std::string failure = run_host(setting);
  if (failure.empty()) return ExitStatus::kDone;
  throw Failure(ExitStatus::kFailed, Problem{"join", command.endpoint, failure});
}

}  // namespace graycube

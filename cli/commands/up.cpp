// graycube up: a farm in the foreground.
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include "cli/commands/commands.hpp"
#include "cli/farm/client.hpp"
#include "cli/farm/host_plan.hpp"
#include "cli/farm/listener.hpp"
#include "cli/farm/loss_options.hpp"
#include "cli/farm/passing_folder.hpp"
#include "cli/farm/supervised_frontal.hpp"
#include "cli/interrupts.hpp"
#include "cli/temporary_place.hpp"
#include "process/log_file.hpp"
#include "transport/endpoint.hpp"
#include "transport/farm_key.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& ipc_endpoint) {
  return fs::path(ipc_endpoint.substr(std::string("ipc://").size())).parent_path();
}

/// Makes the default endpoint's folder, which only the user may enter.
void make_own_folder(const std::string& endpoint) {
  try {
    make_private_folder(folder_of(endpoint).string());
  } catch (const KeyError& e) {
    throw Failure(ExitStatus::kFailed, Problem{"farm", "its folder", e.what()});
  }
}

/// Removes what an ended farm may leave at its endpoint.
class EndpointCleanup {
 public:
  EndpointCleanup(const std::string& endpoint, bool is_default)
      : endpoint_(endpoint), is_default_(is_default) {}
  ~EndpointCleanup() {
    try {
      remove_stale_socket(endpoint_);
      std::error_code ignored;  // not empty, perhaps
      if (is_default_) fs::remove(folder_of(endpoint_), ignored);
    } catch (const Failure&) {
      // Another process has taken the path by now.
    }
  }
  EndpointCleanup(const EndpointCleanup&) = delete;
  EndpointCleanup& operator=(const EndpointCleanup&) = delete;

 private:
  const std::string& endpoint_;
  bool is_default_;
};

/// The endpoint, with this machine's name where it stands for all of its addresses.
std::string reachable(const std::string& endpoint) {
  constexpr std::string_view everywhere = "tcp://0.0.0.0:";
  std::array<char, 256> name{};
  if (!endpoint.starts_with(everywhere) || ::gethostname(name.data(), name.size() - 1) != 0)
    return endpoint;
  return "tcp://" + std::string(name.data()) + ":" + endpoint.substr(everywhere.size());
}

/// What tells other commands where the farm is, if they don't know.
std::string connect_option(const std::string& endpoint, bool is_default) {
  return is_default ? "" : " --connect " + reachable(endpoint);
}

void refuse_second_farm(const std::string& endpoint, const std::string& key, bool is_default) {
  remove_stale_socket(endpoint);
  if (!find_listener(endpoint).is_there) return;
  FarmClient farm({endpoint, key});
  farm.send(control::Nodes{});
  const auto answer = farm.receive(kFirstAnswer);
  throw Failure(ExitStatus::kFailed,
                Problem{"farm", endpoint,
                        answer ? "a farm is running there already; stop it with 'graycube down" +
                                     connect_option(endpoint, is_default) + "'"
                               : "something listens there already, no farm with this key"});
}

/// All arguments but those that SupervisedFrontal adds. Jobs that lie in `passing` rather than
/// where the user wants them end with the farm.
std::vector<std::string> frontal_arguments(const UpCommand& command, const HostPlan& plan,
                                           const fs::path& passing) {
  std::vector<std::string> arguments{"--nodes", std::to_string(plan.nodes), "--threads",
                                     std::to_string(command.threads)};
  arguments.insert(arguments.end(), plan.arguments.begin(), plan.arguments.end());
  if (command.state.empty()) {
    arguments.insert(arguments.end(), {"--state", passing.string(), "--ends-jobs"});
  } else {
    arguments.insert(arguments.end(), {"--state", command.state});
  }
  for (const std::string& word : loss_arguments(command.losses)) arguments.push_back(word);
  if (!command.keep.empty()) arguments.insert(arguments.end(), {"--keep", command.keep});
  if (!command.key.empty()) arguments.insert(arguments.end(), {"--key", command.key});
  if (!command.log.empty()) arguments.insert(arguments.end(), {"--log", command.log});
  if (command.is_quiet) arguments.push_back("--quiet");
  if (command.outbox_rays != 0) {
    arguments.insert(arguments.end(), {"--outbox-rays", std::to_string(command.outbox_rays)});
  }
  return arguments;
}

void print_usage_hint(const HostPlan& plan, const std::string& endpoint, bool is_default) {
  std::string option = connect_option(endpoint, is_default);
  if (plan.allocation) option = " --connect slurm:" + plan.allocation->job;
  std::printf(
      "farm of %u %s at %s; elsewhere: graycube submit SCENE%s; Ctrl-C or 'graycube down%s' "
      "stops it\n",
      plan.nodes, plan.nodes == 1 ? "node" : "nodes", endpoint.c_str(), option.c_str(),
      option.c_str());
  if (plan.kind == FarmKind::kJoined)
    std::printf("hosts join it by: graycube join %s --key FILE\n", endpoint.c_str());
  std::fflush(stdout);
}

/// Refuses folders that the frontal couldn't use, before it is started.
void check_folders(const UpCommand& command, const std::string& endpoint, bool is_default) {
  std::error_code error;
  if (!is_default && endpoint.starts_with("ipc://")) {
    const fs::path folder = folder_of(endpoint);
    if (!fs::is_directory(folder, error))
      throw usage_failure("--listen " + endpoint, folder.string() + " is no folder");
    if (::access(folder.c_str(), W_OK) != 0)
      throw usage_failure("--listen " + endpoint, folder.string() + ": " + std::strerror(errno));
  }
  if (command.state.empty()) return;
  fs::create_directories(command.state, error);
  if (!error && ::access(command.state.c_str(), W_OK) != 0)
    error = std::error_code(errno, std::generic_category());
  if (error) throw usage_failure("--state " + command.state, error.message());
}

/// The log, if one is wanted: what can't be written is refused before anything is started.
std::unique_ptr<LogFile> open_log(const std::string& file) {
  if (file.empty()) return nullptr;
  try {
    return std::make_unique<LogFile>(
        file, "farm: 'graycube up' begins, process " + std::to_string(::getpid()));
  } catch (const std::runtime_error& e) {
    throw usage_failure("--log", e.what());
  }
}

/// What a farm in a job of Slurm leaves for commands elsewhere.
class FarmFilesLeft {
 public:
  explicit FarmFilesLeft(const std::optional<Allocation>& allocation) {
    if (allocation) files_ = farm_files(allocation->job);
  }
  ~FarmFilesLeft() {
    if (files_) remove_farm_files(*files_);
  }
  FarmFilesLeft(const FarmFilesLeft&) = delete;
  FarmFilesLeft& operator=(const FarmFilesLeft&) = delete;
  /// Where the farm's key is to be kept, if the user doesn't say.
  std::string key_file() const { return files_ ? files_->key : ""; }
  void make_folder() const {
    if (files_) make_farm_folder(*files_);
  }
  void leave(const std::string& endpoint) const {
    if (files_) write_farm_endpoint(*files_, endpoint);
  }

 private:
  std::optional<FarmFiles> files_;
};

}  // namespace

ExitStatus run(const UpCommand& asked) {
  const HostPlan plan = plan_hosts(asked.farm, asked.nodes, asked.listen);
  const FarmFilesLeft left(plan.allocation);
  UpCommand command = asked;
  command.listen = plan.listen;
  if (command.key.empty()) command.key = left.key_file();
  const bool is_default = command.listen.empty();
  const std::string endpoint = is_default ? default_endpoint() : command.listen;
  if (const auto problem = endpoint_problem(endpoint, !command.key.empty())) {
    throw usage_failure("--listen " + endpoint, *problem);
  }
  if (!command.http.empty()) {
    if (const auto problem = endpoint_problem("tcp://" + command.http)) {
      throw usage_failure("--http " + command.http, *problem);
    }
  }
  check_folders(command, endpoint, is_default);
  catch_interrupts("up", 0);
  if (is_default) make_own_folder(endpoint);
  refuse_second_farm(endpoint, command.key, is_default);
  const InterruptsHeld held;
  const EndpointCleanup cleanup(endpoint, is_default);
  const std::unique_ptr<LogFile> log = open_log(command.log);
  std::optional<PassingFolder> passing;
  clear_left_passing_folders();
  if (command.state.empty()) {
    check_temporary_place();
    passing.emplace();
  }
  left.make_folder();
  SupervisedFrontal frontal(
      frontal_arguments(command, plan, passing ? passing->path() : fs::path()), endpoint,
      command.http, log.get());
  left.leave(frontal.endpoint());
  if (!frontal.page().empty()) {
    std::printf("web page at %s\nthe same with leave to cancel jobs: %s/#token=%s\n",
                frontal.page().c_str(), frontal.page().c_str(), frontal.token().c_str());
  }
  if (!frontal.key_file().empty()) std::printf("key in %s\n", frontal.key_file().c_str());
  print_usage_hint(plan, frontal.endpoint(), is_default);
  frontal.run();
  frontal.stop();
  return ExitStatus::kDone;
}

}  // namespace graycube

// Steps of Slurm that join hosts of the allocation to the farm: a process of srun for each.
#pragma once

#include <sys/types.h>

#include <map>
#include <string>
#include <vector>

namespace graycube::slurm {

struct StepSetting {
  /// The program graycube, at the same place on each host.
  std::string program;
  /// The farm's endpoint.
  std::string endpoint;
  /// The farm's key, as hosts read it: they get it from standard input, so that it stands neither
  /// on a command line nor in an environment, nor in a file that all hosts would have to share.
  std::string key_text;
  /// Nodes of each host.
  std::uint32_t slots = 1;
};

struct StepEnd {
  std::string host;
  /// For people: "exited with status 1".
  std::string how;
};

class StepProcesses {
 public:
  explicit StepProcesses(StepSetting setting) : setting_(std::move(setting)) {}
  /// Asks Slurm to end the steps.
  ~StepProcesses();
  StepProcesses(const StepProcesses&) = delete;
  StepProcesses& operator=(const StepProcesses&) = delete;

  /// What can't be started is told of by reap().
  void start(const std::string& host, std::uint32_t cpus);
  void end(const std::string& host);
  std::vector<StepEnd> reap();

 private:
  StepSetting setting_;
  std::map<pid_t, std::string> running_;
  std::vector<StepEnd> not_started_;
};

/// srun's command line for a host.
std::vector<std::string> step_command(const StepSetting& setting, const std::string& host,
                                      std::uint32_t cpus);

}  // namespace graycube::slurm

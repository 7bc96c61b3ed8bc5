// What the environment of a job of Slurm tells, and what is made of it.
#include "cli/farm/allocation.hpp"

#include <cstdlib>
#include <fstream>

#include "catch.hpp"
#include "cli/failure.hpp"
#include "cli/farm/host_plan.hpp"
#include "process/temporary_folder.hpp"

namespace graycube {
namespace {

using Counts = std::vector<std::uint32_t>;
using Variables = std::vector<std::pair<const char*, std::string>>;

/// Variables of the environment, as long as it lives.
class Environment {
 public:
  explicit Environment(const Variables& variables) {
    for (const auto& [name, value] : variables) {
      const char* before = std::getenv(name);
      before_.emplace_back(name,
                           before != nullptr ? std::optional<std::string>(before) : std::nullopt);
      ::setenv(name, value.c_str(), 1);
    }
  }
  ~Environment() {
    for (const auto& [name, value] : before_)
      value ? ::setenv(name, value->c_str(), 1) : ::unsetenv(name);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  std::vector<std::pair<const char*, std::optional<std::string>>> before_;
};

/// A folder with a program that answers as Slurm's own does.
class SlurmTools {
 public:
  explicit SlurmTools(const std::string& script) {
    const auto path = folder_.path() / "scontrol";
    std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }
  std::string path() const { return folder_.path().string() + ":/usr/bin:/bin"; }

 private:
  TemporaryFolder folder_;
};

TEST_CASE("CPUs of an allocation's hosts are read as Slurm writes them, and nothing else is") {
  CHECK(cpus_of_hosts("4") == Counts{4});
  CHECK(cpus_of_hosts("4(x2),2") == Counts{4, 4, 2});
  CHECK(cpus_of_hosts("72(x1),8(x3)") == Counts{72, 8, 8, 8});
  for (const char* wrong : {"", "x", "4(x", "4(x)", "4(x2", "(x2)", "4,", "4,,2", "-4", "4(x0)",
                            "0", "4(x99999999)", "99999999999"}) {
    INFO(wrong);
    CHECK_FALSE(cpus_of_hosts(wrong));
  }
}

TEST_CASE("an allocation is found by what the environment and scontrol tell") {
  const SlurmTools tools(
      "[ \"$*\" = 'show hostnames n[1-3]' ] || exit 1; echo n1; echo n2; echo n3");
  const Environment job(Variables{{"PATH", tools.path()},
                                  {"SLURM_JOB_ID", "25"},
                                  {"SLURM_JOB_NODELIST", "n[1-3]"},
                                  {"SLURM_JOB_CPUS_PER_NODE", "4(x2),2"}});
  const auto allocation = find_allocation();
  REQUIRE(allocation);
  CHECK(allocation->job == "25");
  REQUIRE(allocation->hosts.size() == 3);
  CHECK(allocation->hosts[2].name == "n3");
  CHECK(allocation->hosts[2].cpus == 2);
  CHECK(allocation->cpus() == 10);
}

TEST_CASE("what can't be an allocation is refused with a sentence") {
  const SlurmTools fine("echo n1"), broken("exit 1");
  const Environment job(Variables{{"PATH", fine.path()},
                                  {"SLURM_JOB_ID", "25"},
                                  {"SLURM_JOB_NODELIST", "n1"},
                                  {"SLURM_JOB_CPUS_PER_NODE", "4"}});
  CHECK(find_allocation());
  const auto fails_with = [](const char* name, const std::string& value) {
    const Environment wrong(Variables{{name, value}});
    CHECK_THROWS_AS(find_allocation(), Failure);
  };
  fails_with("SLURM_JOB_ID", "../25");
  fails_with("SLURM_JOB_CPUS_PER_NODE", "4(x2)");
  fails_with("SLURM_JOB_CPUS_PER_NODE", "");
  fails_with("PATH", broken.path());
  fails_with("PATH", "/nowhere");
}

TEST_CASE("outside of a job the nodes run here, and --farm slurm says why it can't be") {
  const Environment none(Variables{{"SLURM_JOB_ID", ""}});
  const HostPlan plan = plan_hosts(FarmKind::kAuto, 4, "");
  CHECK(plan.kind == FarmKind::kLocal);
  CHECK(plan.nodes == 4);
  CHECK(plan.arguments.empty());
  CHECK_THROWS_AS(plan_hosts(FarmKind::kSlurm, 4, ""), Failure);
}

TEST_CASE("in a job the nodes run on its hosts, unless --farm local says otherwise") {
  const SlurmTools tools("echo n1; echo n2");
  const Environment job(Variables{{"PATH", tools.path()},
                                  {"SLURM_JOB_ID", "25"},
                                  {"SLURM_JOB_NODELIST", "n[1-2]"},
                                  {"SLURM_JOB_CPUS_PER_NODE", "6(x2)"}});
  CHECK(plan_hosts(FarmKind::kLocal, 0, "").kind == FarmKind::kLocal);
  const HostPlan plan = plan_hosts(FarmKind::kAuto, 0, "tcp://127.0.0.1:*");
  CHECK(plan.kind == FarmKind::kSlurm);
  CHECK(plan.nodes == 8);  // of 12 CPUs
  CHECK(plan.arguments ==
        std::vector<std::string>{"--joined", "--slurm", "n1:6,n2:6", "--slots", "4"});
}

TEST_CASE("a farm that hosts join needs a port at which they can") {
  CHECK_THROWS_AS(plan_hosts(FarmKind::kJoined, 4, ""), Failure);
  CHECK_THROWS_AS(plan_hosts(FarmKind::kJoined, 4, "ipc:///tmp/x"), Failure);
  const HostPlan plan = plan_hosts(FarmKind::kJoined, 4, "tcp://10.0.0.1:7411");
  CHECK(plan.arguments == std::vector<std::string>{"--joined"});
}

TEST_CASE("all nodes find a slot, the same power of two on each host") {
  Allocation allocation{"1", std::vector<Allocation::Host>(3)};
  CHECK(slots_of_each(allocation, 8) == 4);
  CHECK(slots_of_each(allocation, 2) == 1);
  CHECK(slots_of_each(allocation, 64) == 32);
}

TEST_CASE("a farm in a job leaves its endpoint where other commands find it, and takes it away") {
  const TemporaryFolder home;
  const Environment environment(Variables{{"HOME", home.path().string()}});
  const FarmFiles files = farm_files("25");
  CHECK_THROWS_AS(read_farm_endpoint("25"), Failure);
  make_farm_folder(files);
  write_farm_endpoint(files, "tcp://10.0.0.1:7411");
  CHECK(read_farm_endpoint("25") == "tcp://10.0.0.1:7411");
  remove_farm_files(files);
  CHECK_THROWS_AS(read_farm_endpoint("25"), Failure);
  CHECK_THROWS_AS(farm_files("../25"), Failure);
  CHECK_THROWS_AS(farm_files(""), Failure);
}

}  // namespace
}  // namespace graycube

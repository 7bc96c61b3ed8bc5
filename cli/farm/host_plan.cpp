#include "cli/farm/host_plan.hpp"

#include <algorithm>
#include <bit>

#include "cli/failure.hpp"
#include "cli/option_values.hpp"
#include "topology/hypercube.hpp"

namespace graycube {
namespace {

HostPlan plan_joined(std::uint32_t nodes, const std::string& listen) {
  if (!listen.starts_with("tcp://")) {
    throw usage_failure("--farm joined",
                        "hosts join at a TCP port: name it by --listen tcp://ADDRESS:PORT");
  }
  return {FarmKind::kJoined, nodes != 0 ? nodes : default_nodes(), listen, {"--joined"}, {}};
}

HostPlan plan_slurm(std::uint32_t nodes, const std::string& listen, Allocation allocation) {
  HostPlan plan{FarmKind::kSlurm, nodes, listen, {"--joined"}, {}};
  if (nodes == 0) plan.nodes = std::bit_floor(std::clamp(allocation.cpus(), 1u, kMaxNodes));
  if (listen.empty()) plan.listen = "tcp://" + address_in(allocation) + ":*";
  std::string hosts;
  for (const Allocation::Host& host : allocation.hosts)
    hosts += (hosts.empty() ? "" : ",") + host.name + ":" + std::to_string(host.cpus);
  plan.arguments.insert(
      plan.arguments.end(),
      {"--slurm", hosts, "--slots", std::to_string(slots_of_each(allocation, plan.nodes))});
  plan.allocation = std::move(allocation);
  return plan;
}

}  // namespace

HostPlan plan_hosts(FarmKind kind, std::uint32_t nodes, const std::string& listen) {
  if (kind == FarmKind::kJoined) return plan_joined(nodes, listen);
  if (kind != FarmKind::kLocal) {
    if (auto allocation = find_allocation())
      return plan_slurm(nodes, listen, *std::move(allocation));
    if (kind == FarmKind::kSlurm) {
      throw usage_failure(
          "--farm slurm",
          "this is no job of Slurm: SLURM_JOB_ID and SLURM_JOB_NODELIST aren't set");
    }
  }
  return {FarmKind::kLocal, nodes != 0 ? nodes : default_nodes(), listen, {}, {}};
}

}  // namespace graycube

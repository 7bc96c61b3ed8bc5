#include "cli/farm/address.hpp"

#include <cstdlib>
#include <string_view>

#include "cli/failure.hpp"
#include "cli/farm/allocation.hpp"
#include "transport/endpoint.hpp"

namespace graycube {

void resolve(FarmAddress& farm) {
  constexpr std::string_view slurm = "slurm:";
  const char* origin = "--connect";
  if (farm.endpoint.empty()) {
    const char* variable = std::getenv("GRAYCUBE_FRONTAL");
    const bool is_set = variable != nullptr && variable[0] != '\0';
    origin = is_set ? "GRAYCUBE_FRONTAL" : "XDG_RUNTIME_DIR";
    farm.endpoint = is_set ? variable : default_endpoint();
  }
  if (farm.endpoint.starts_with(slurm)) {
    const std::string job = farm.endpoint.substr(slurm.size());
    farm.endpoint = read_farm_endpoint(job);
    if (farm.key_file.empty()) farm.key_file = farm_files(job).key;
  }
  if (const auto problem = endpoint_problem(farm.endpoint, !farm.key_file.empty()))
    throw usage_failure(std::string(origin) + " " + farm.endpoint, *problem);
}

}  // namespace graycube

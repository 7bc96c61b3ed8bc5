// graycube key: prints what opens a farm's door at a TCP port.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "transport/farm_key.hpp"

namespace graycube {

ExitStatus run(const KeyCommand& command) {
  std::string text;
  try {
    text = command.of_farm.empty()
               ? text_of_farm_key(make_secret())
               : text_of_client_key(client_keys_of(farm_keys_of(read_farm_key(command.of_farm))));
  } catch (const KeyError& e) {
    throw usage_failure("--client", e.what());
  }
  std::printf("%s\n", text.c_str());
  return ExitStatus::kDone;
}

}  // namespace graycube

// graycube key: prints what opens a farm's door at a TCP port.
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "cli/commands/commands.hpp"
#include "transport/farm_key.hpp"

namespace graycube {
namespace {

/// A file that a shell has made for this output is everybody's to read, as the umask usually has
/// it; one that others can read is no key.
void keep_output_to_owner() {
  struct stat status {};
  if (::fstat(STDOUT_FILENO, &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (::fchmod(STDOUT_FILENO, 0600) != 0)
    throw Failure(ExitStatus::kFailed, Problem{"key", "standard output", std::strerror(errno)});
}

}  // namespace

ExitStatus run(const KeyCommand& command) {
  std::string text;
  try {
    text = command.of_farm.empty()
               ? text_of_farm_key(make_secret())
               : text_of_client_key(client_keys_of(farm_keys_of(read_farm_key(command.of_farm))));
  } catch (const KeyError& e) {
    throw usage_failure("--client", e.what());
  }
  keep_output_to_owner();
  std::printf("%s\n", text.c_str());
  return ExitStatus::kDone;
}

}  // namespace graycube

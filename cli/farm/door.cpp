#include "cli/farm/door.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <thread>

#include "cli/failure.hpp"
#include "cli/farm/listener_owner.hpp"
#include "cli/interrupts.hpp"
#include "transport/endpoint.hpp"
#include "transport/farm_key.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

/// How long a farm that is just being started may take until it listens.
constexpr std::chrono::seconds kStartPatience{2};
constexpr std::chrono::milliseconds kLookInterval{10};

Failure untrusted(const std::string& where, const std::string& why) {
  return {ExitStatus::kFailed, Problem{"farm", where, why}};
}

Failure nobody_answers(const std::string& endpoint) {
  return untrusted(endpoint, "nobody answers; start one with 'graycube up'");
}

/// The first owner that `look` finds before patience ends.
std::optional<uid_t> wait_for_owner(const std::function<std::optional<uid_t>()>& look) {
  const auto until = std::chrono::steady_clock::now() + kStartPatience;
  for (;;) {
    if (const auto owner = look()) return owner;
    if (std::chrono::steady_clock::now() > until) return std::nullopt;
    throw_if_interrupted();
    std::this_thread::sleep_for(kLookInterval);
  }
}

void check_owner(const std::string& endpoint, std::optional<uid_t> owner) {
  if (!owner) throw nobody_answers(endpoint);
  if (*owner != ::geteuid()) {
    throw untrusted(endpoint, "it is another user's (user id " + std::to_string(*owner) +
                                  "); nothing was sent there");
  }
}

std::optional<uid_t> owner_of_socket(const std::string& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) return std::nullopt;
  return status.st_uid;
}

void check_local(const std::string& endpoint, const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  struct stat status {};
  const auto owner_of_folder = [&]() -> std::optional<uid_t> {
    if (::stat(folder.c_str(), &status) != 0) return std::nullopt;
    return status.st_uid;
  };
  if (!wait_for_owner(owner_of_folder)) throw nobody_answers(endpoint);
  const bool others_write = (status.st_mode & 0022) != 0;
  if (status.st_uid != ::geteuid() && status.st_uid != 0)
    throw untrusted(folder, "it is another user's folder; nothing was sent there");
  if (others_write && (status.st_mode & S_ISVTX) == 0)
    throw untrusted(folder, "others may put sockets into it; nothing was sent there");
  // Others can make a socket here, but not replace one that is there.
  if (others_write)
    return check_owner(endpoint, wait_for_owner([&] { return owner_of_socket(path); }));
  if (const auto owner = owner_of_socket(path)) check_owner(endpoint, owner);
}

}  // namespace

std::optional<CurveAccess> access_to(const FarmAddress& farm) {
  constexpr std::string_view ipc = "ipc://";
  if (!needs_key(farm.endpoint)) {
    check_local(farm.endpoint, farm.endpoint.substr(ipc.size()));
    return std::nullopt;
  }
  if (is_on_loopback(farm.endpoint))
    check_owner(farm.endpoint, wait_for_owner([&] { return owner_of_listener(farm.endpoint); }));
  try {
    return access_of_client(
        read_client_keys(farm.key_file.empty() ? key_file_of(farm.endpoint) : farm.key_file));
  } catch (const KeyError& e) {
    throw untrusted(farm.endpoint, std::string("its key can't be read: ") + e.what());
  }
}

}  // namespace graycube

#include "cli/farm/listener.hpp"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>

#include "cli/failure.hpp"
#include "transport/endpoint.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kIpc = "ipc://", kTcp = "tcp://";

class Socket {
 public:
  explicit Socket(int family) : descriptor_(::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  bool connects(const sockaddr* address, socklen_t size) const {
    return descriptor_ >= 0 && ::connect(descriptor_, address, size) == 0;
  }
  pid_t peer() const {
    ucred credentials{};
    socklen_t size = sizeof credentials;
    if (::getsockopt(descriptor_, SOL_SOCKET, SO_PEERCRED, &credentials, &size) != 0) return 0;
    return credentials.pid;
  }

 private:
  int descriptor_;
};

Listener find_local(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() > kMaxSocketPath) return {};
  std::memcpy(address.sun_path, path.data(), path.size());
  const Socket socket(AF_UNIX);
  if (!socket.connects(reinterpret_cast<const sockaddr*>(&address), sizeof address)) return {};
  return {true, socket.peer()};
}

Listener find_on_loopback(std::string host, const std::string& port) {
  if (host.starts_with("[") && host.ends_with("]")) host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0) return {};
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, &::freeaddrinfo);
  for (const addrinfo* a = found; a != nullptr; a = a->ai_next) {
    if (Socket(a->ai_family).connects(a->ai_addr, a->ai_addrlen)) return {true, 0};
  }
  return {};
}

}  // namespace

Listener find_listener(const std::string& endpoint) {
  if (endpoint.starts_with(kIpc)) return find_local(endpoint.substr(kIpc.size()));
  const std::string address = endpoint.substr(kTcp.size());
  const auto colon = address.rfind(':');
  const std::string port = address.substr(colon + 1);
  if (port == "*") return {};
  return find_on_loopback(address.substr(0, colon), port);
}

void remove_stale_socket(const std::string& endpoint) {
  if (!endpoint.starts_with(kIpc)) return;
  const fs::path path = endpoint.substr(kIpc.size());
  std::error_code error;
  const auto status = fs::symlink_status(path, error);
  if (!fs::exists(status)) return;
  if (!fs::is_socket(status)) {
    throw Failure(ExitStatus::kFailed,
                  Problem{"farm", endpoint, "the path is taken by something that is no socket"});
  }
  if (!find_listener(endpoint).is_there) fs::remove(path, error);
}

}  // namespace graycube

#include "transport/endpoint.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string>

namespace graycube {
namespace {

bool is_port(std::string_view text) {
  if (text == "*") return true;
  if (text.empty() || text.size() > 5) return false;
  if (!std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); })) {
    return false;
  }
  const int port = std::atoi(std::string(text).c_str());
  return port > 0 && port < 65536;
}

/// Whether the host is in 127.0.0.0/8, or is ::1 or localhost.
bool is_loopback(std::string_view host) {
  if (host == "localhost" || host == "[::1]") return true;
  if (!host.starts_with("127.")) return false;
  int parts = 0;
  std::size_t begin = 0;
  while (begin <= host.size()) {
    const std::size_t end = std::min(host.find('.', begin), host.size());
    const std::string part(host.substr(begin, end - begin));
    if (part.empty() || part.size() > 3 ||
        !std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isdigit(c); }) ||
        std::atoi(part.c_str()) > 255) {
      return false;
    }
    ++parts;
    begin = end + 1;
  }
  return parts == 4;
}

}  // namespace

std::optional<std::string> endpoint_problem(std::string_view endpoint) {
  if (endpoint.starts_with("ipc://")) {
    const std::string_view path = endpoint.substr(6);
    if (path.empty() || path.front() != '/') return "a local socket needs an absolute path";
    if (path.size() > kMaxSocketPath) {
      return "the socket's path is longer than " + std::to_string(kMaxSocketPath) + " bytes";
    }
    return std::nullopt;
  }
  if (!endpoint.starts_with("tcp://")) return "expected ipc:///PATH or tcp://127.0.0.1:PORT";
  const std::string_view address = endpoint.substr(6);
  const std::size_t colon = address.rfind(':');
  if (colon == std::string_view::npos || !is_port(address.substr(colon + 1))) {
    return "expected a port after the last ':'";
  }
  if (!is_loopback(address.substr(0, colon))) {
    return "only loopback addresses (127.0.0.1, [::1], localhost) may be used: what is said there "
           "isn't encrypted yet";
  }
  return std::nullopt;
}

std::string run_folder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && runtime[0] == '/') return std::string(runtime) + "/graycube";
  return "/tmp/graycube-" + std::to_string(::geteuid());
}

std::string default_endpoint() { return "ipc://" + run_folder() + "/frontal"; }

}  // namespace graycube

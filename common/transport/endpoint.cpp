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

/// A name, an IPv4 address, an IPv6 address in brackets, or "*".
bool is_host(std::string_view host) {
  if (host == "*") return true;
  const bool is_ipv6 = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (is_ipv6) host = host.substr(1, host.size() - 2);
  const std::string_view signs = is_ipv6 ? ":.%" : ".-_";
  return !host.empty() && std::all_of(host.begin(), host.end(), [&](unsigned char c) {
    return std::isalnum(c) || signs.find(static_cast<char>(c)) != signs.npos;
  });
}

constexpr std::string_view kTcp = "tcp://";

/// The host of a TCP endpoint that has a port.
std::string_view host_of(std::string_view endpoint) {
  endpoint.remove_prefix(kTcp.size());
  return endpoint.substr(0, endpoint.rfind(':'));
}

}  // namespace

std::optional<std::string> endpoint_problem(std::string_view endpoint, bool has_key) {
  if (endpoint.starts_with("ipc://")) {
    const std::string_view path = endpoint.substr(6);
    if (path.empty() || path.front() != '/') return "a local socket needs an absolute path";
    if (path.size() > kMaxSocketPath) {
      return "the socket's path is longer than " + std::to_string(kMaxSocketPath) + " bytes";
    }
    return std::nullopt;
  }
  if (!endpoint.starts_with(kTcp)) return "expected ipc:///PATH or tcp://HOST:PORT";
  const std::string_view address = endpoint.substr(kTcp.size());
  const std::size_t colon = address.rfind(':');
  if (colon == std::string_view::npos || !is_port(address.substr(colon + 1))) {
    return "expected a port after the last ':'";
  }
  if (!is_host(host_of(endpoint))) return "expected an address or a name, or *, before the port";
  if (!has_key && !is_loopback(host_of(endpoint))) {
    return "other than loopback addresses (127.0.0.1, [::1], localhost) need a key: --key FILE, "
           "with a file that 'graycube key' has made";
  }
  return std::nullopt;
}

std::string tcp_host_of(std::string_view endpoint) {
  constexpr std::string_view tcp = "tcp://";
  return std::string(endpoint.substr(tcp.size(), endpoint.rfind(':') - tcp.size()));
}

bool is_on_loopback(std::string_view endpoint) {
  return endpoint.starts_with(kTcp) && is_loopback(host_of(endpoint));
}

std::string run_folder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && runtime[0] == '/') return std::string(runtime) + "/graycube";
  return "/tmp/graycube-" + std::to_string(::geteuid());
}

std::string default_endpoint() { return "ipc://" + run_folder() + "/frontal"; }

}  // namespace graycube

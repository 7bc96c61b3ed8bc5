#include "integration/browser.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "catch.hpp"

namespace graycube {

WebConnection::WebConnection(std::uint16_t port)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  REQUIRE(::connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  const timeval patience{10, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
}

WebConnection::~WebConnection() {
  if (socket_ >= 0) ::close(socket_);
}

WebConnection::WebConnection(WebConnection&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)) {}

bool WebConnection::send(const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return false;
    sent += static_cast<std::size_t>(n);
  }
  return true;
}

std::string WebConnection::read_to_end() {
  std::string all;
  std::array<char, 65536> part;
  for (;;) {
    const ssize_t got = ::recv(socket_, part.data(), part.size(), 0);
    if (got <= 0) return all;
    all.append(part.data(), static_cast<std::size_t>(got));
  }
}

Browser::Browser(const std::string& said) {
  const std::string before = "http://127.0.0.1:";
  const std::size_t at = said.find(before);
  REQUIRE(at != std::string::npos);
  port_ = static_cast<std::uint16_t>(std::stoi(said.substr(at + before.size())));
}

WebAnswer Browser::ask(const std::string& what, const std::string& headers,
                       const std::string& body) const {
  WebConnection connection(port_);
  std::string request = what + " HTTP/1.1\r\nConnection: close\r\n" + headers;
  if (headers.find("Host:") == std::string::npos)
    request += "Host: 127.0.0.1:" + std::to_string(port_) + "\r\n";
  if (!body.empty()) request += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  connection.send(request + "\r\n" + body);
  const std::string all = connection.read_to_end();
  const std::size_t end = all.find("\r\n\r\n");
  if (!all.starts_with("HTTP/1.1 ") || end == std::string::npos) return {};
  return {std::stoi(all.substr(9)), all.substr(end + 4)};
}

}  // namespace graycube

// A web browser for tests: one connection for each request, which may be as odd as a test wants.
#pragma once

#include <cstdint>
#include <string>

namespace graycube {

class WebConnection {
 public:
  explicit WebConnection(std::uint16_t port);
  ~WebConnection();
  WebConnection(WebConnection&& other) noexcept;
  WebConnection& operator=(WebConnection&&) = delete;

  /// False when the other side has hung up.
  bool send(const std::string& bytes);
  /// All that comes until the other side hangs up, or for ten seconds.
  std::string read_to_end();

 private:
  int socket_;
};

struct WebAnswer {
  /// 0 when none came.
  int status = 0;
  std::string body;
};

class Browser {
 public:
  /// The port of http://127.0.0.1:PORT, wherever that stands in what `graycube up` says.
  explicit Browser(const std::string& said);

  std::uint16_t port() const { return port_; }
  WebAnswer get(const std::string& path, const std::string& headers = "") const {
    return ask("GET " + path, headers);
  }
  /// `headers`: lines that end with "\r\n", beside Host and Connection. A Host there goes instead.
  WebAnswer ask(const std::string& what, const std::string& headers = "",
                const std::string& body = "") const;

 private:
  std::uint16_t port_;
};

}  // namespace graycube

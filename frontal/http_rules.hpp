// Who may ask a farm's web server for what. Any page that a browser shows can make it send requests
// to the loopback, and any user of the machine can send them himself.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace graycube {

/// What a request tells that decides whether it is answered; empty where it tells nothing.
struct HttpRequestFacts {
  std::string_view target{}, host{}, origin{};
  /// Of the header Sec-Fetch-Site: where the page lies that made the browser ask.
  std::string_view fetch_site{};
  /// Of the header Authorization.
  std::string_view authorization{};
  bool is_write = false;
};

enum class HttpVerdict {
  kGranted,
  /// It is meant for another server: its host is neither a loopback name nor the bound address, so
  /// that a name of somebody else leads here (DNS rebinding).
  kForeignHost,
  /// A page of another site asks.
  kForeignPage,
  /// It would change something, and doesn't show the token.
  kNoToken,
};

class HttpRules {
 public:
  /// `host` and `port`: where the server listens; `token`: what those show who may change things.
  HttpRules(std::string host, std::uint16_t port, std::string token);

  HttpVerdict verdict(const HttpRequestFacts& request) const;

 private:
  bool is_own_host(std::string_view host) const;
  bool shows_token(std::string_view authorization) const;

  std::string host_, port_, token_;
};

}  // namespace graycube

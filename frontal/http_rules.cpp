#include "frontal/http_rules.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "transport/same_secret_text.hpp"

namespace graycube {
namespace {

bool is_same_name(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

HttpRules::HttpRules(std::string host, std::uint16_t port, std::string token)
    : host_(std::move(host)), port_(std::to_string(port)), token_(std::move(token)) {}

HttpVerdict HttpRules::verdict(const HttpRequestFacts& request) const {
  if (!is_own_host(request.host)) return HttpVerdict::kForeignHost;
  if (!request.origin.empty()) {
    constexpr std::string_view scheme = "http://";
    const bool is_own =
        request.origin.starts_with(scheme) && is_own_host(request.origin.substr(scheme.size()));
    if (!is_own) return HttpVerdict::kForeignPage;
  }
  // A link elsewhere may lead to the page, but nothing else may be made part of a foreign one.
  const bool is_own_site = request.fetch_site.empty() || request.fetch_site == "same-origin" ||
                           request.fetch_site == "none";
  if (!is_own_site && (request.target != "/" || request.is_write)) return HttpVerdict::kForeignPage;
  if (request.is_write && !shows_token(request.authorization)) return HttpVerdict::kNoToken;
  return HttpVerdict::kGranted;
}

/// Whether "HOST:PORT" is this server. The port may be missing only where it is HTTP's own.
bool HttpRules::is_own_host(std::string_view host) const {
  const std::size_t colon = host.rfind(':');
  const bool has_port = colon != host.npos && host.find(']', colon) == host.npos;
  const std::string_view port = has_port ? host.substr(colon + 1) : "80";
  if (port != port_) return false;
  const std::string_view name = has_port ? host.substr(0, colon) : host;
  const std::array<std::string_view, 4> own{host_, "localhost", "127.0.0.1", "[::1]"};
  return std::ranges::any_of(own, [&](std::string_view o) { return is_same_name(name, o); });
}

bool HttpRules::shows_token(std::string_view authorization) const {
  constexpr std::string_view scheme = "Bearer ";
  return !token_.empty() && authorization.starts_with(scheme) &&
         is_same_secret_text(authorization.substr(scheme.size()), token_);
}

}  // namespace graycube

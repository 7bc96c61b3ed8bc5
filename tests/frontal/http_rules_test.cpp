#include "frontal/http_rules.hpp"

#include "catch.hpp"

namespace graycube {
namespace {

const std::string kToken(64, 'a');

HttpVerdict verdict(const HttpRequestFacts& facts) {
  return HttpRules("127.0.0.2", 8080, kToken).verdict(facts);
}

TEST_CASE("only requests for the server's own address or a loopback name are answered") {
  for (const char* own :
       {"127.0.0.2:8080", "127.0.0.1:8080", "localhost:8080", "LocalHost:8080", "[::1]:8080"}) {
    INFO(own);
    CHECK(verdict({.target = "/", .host = own}) == HttpVerdict::kGranted);
  }
  for (const char* foreign : {"", "example.com:8080", "127.0.0.2", "127.0.0.2:80", "127.0.0.3:8080",
                              "localhost.example.com:8080", "[::1]", "127.0.0.2:8080:8080"}) {
    INFO(foreign);
    CHECK(verdict({.target = "/", .host = foreign}) == HttpVerdict::kForeignHost);
  }
  CHECK(HttpRules("127.0.0.1", 80, kToken).verdict({.target = "/", .host = "127.0.0.1"}) ==
        HttpVerdict::kGranted);
}

TEST_CASE("pages of other sites get nothing, but may link to the page") {
  HttpRequestFacts facts{.target = "/api/jobs", .host = "localhost:8080"};
  facts.origin = "http://localhost:8080";
  CHECK(verdict(facts) == HttpVerdict::kGranted);
  for (const char* foreign : {"http://example.com", "null", "https://localhost:8080",
                              "http://localhost:8081", "http://localhost:8080.example.com"}) {
    INFO(foreign);
    facts.origin = foreign;
    CHECK(verdict(facts) == HttpVerdict::kForeignPage);
  }
  facts.origin = "";
  for (const char* site : {"cross-site", "same-site"}) {
    facts.fetch_site = site;
    facts.target = "/jobs/1.png";
    CHECK(verdict(facts) == HttpVerdict::kForeignPage);
    facts.target = "/";
    CHECK(verdict(facts) == HttpVerdict::kGranted);
  }
}

TEST_CASE("whoever changes something shows the token") {
  HttpRequestFacts facts{
      .target = "/api/jobs/1/cancel", .host = "localhost:8080", .is_write = true};
  const std::string right = "Bearer " + kToken, longer = right + "a", other = "Basic " + kToken,
                    wrong = "Bearer " + std::string(64, 'b');
  facts.authorization = right;
  CHECK(verdict(facts) == HttpVerdict::kGranted);
  for (const std::string& shown : {std::string(), std::string("Bearer "), longer, other, wrong}) {
    facts.authorization = shown;
    CHECK(verdict(facts) == HttpVerdict::kNoToken);
  }
  facts.authorization = "Bearer ";
  CHECK(HttpRules("127.0.0.2", 8080, "").verdict(facts) == HttpVerdict::kNoToken);
}

}  // namespace
}  // namespace graycube

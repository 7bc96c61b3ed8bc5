// A farm's web page: what it shows, whom it answers, and that nobody can hold it up.
#include <thread>
#include <vector>

#include "catch.hpp"
#include "integration/browser.hpp"
#include "integration/farm.hpp"

namespace graycube {
namespace {

std::string first() { return scene_file("first.json").string(); }

std::string token_in(const std::string& said) {
  const std::string before = "#token=";
  const std::size_t at = said.find(before);
  REQUIRE(at != std::string::npos);
  return said.substr(at + before.size(), 64);
}

TEST_CASE("the farm's web page shows jobs, nodes and pictures, and refuses what isn't there") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--http", "127.0.0.1:*"});
  const Browser browser(farm.up().out());
  const std::string job = submit(sandbox, {first(), "--size", "48x32"});
  ok(sandbox, {"watch", job});
  const WebAnswer page = browser.get("/");
  CHECK(page.status == 200);
  CHECK(page.body.find("<title>Graycube</title>") != std::string::npos);
  CHECK(nlohmann::json::parse(browser.get("/api/jobs").body)["jobs"][0]["state"] == "done");
  CHECK(nlohmann::json::parse(browser.get("/api/nodes").body)["nodes"].size() == 4);
  const WebAnswer picture = browser.get("/jobs/" + job + ".png");
  CHECK(picture.status == 200);
  ok(sandbox, {"fetch", job, "-o", "a.exr", "--png", "a.png"});
  CHECK((picture.body == file_bytes(sandbox / "a.png")));
  for (const char* path :
       {"/jobs/77.png", "/api/jobs/77", "/jobs/99999999999999.png", "/nothing", "/jobs/x.png"}) {
    INFO(path);
    CHECK(browser.get(path).status == 404);
  }
  ok(sandbox, {"down"});
  CHECK(farm.up().wait(10s).status == 0);
  CHECK(sandbox.processes().empty());
}

TEST_CASE("jobs are cancelled by those who show the token, not by others or by foreign pages") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--http", "127.0.0.1:*"});
  const Browser browser(farm.up().out());
  const std::string bearer = "Authorization: Bearer " + token_in(farm.up().out()) + "\r\n";
  const std::string job = submit(sandbox, {first(), "--size", "3000x3000", "--samples", "8"});
  const std::string cancel = "POST /api/jobs/" + job + "/cancel";
  CHECK(browser.ask(cancel).status == 401);
  CHECK(browser.ask(cancel, "Authorization: Bearer " + std::string(64, '0') + "\r\n").status ==
        401);
  CHECK(browser.ask(cancel, bearer + "Origin: http://example.com\r\n").status == 403);
  CHECK(browser.ask(cancel, bearer + "Host: example.com\r\n").status == 403);
  CHECK(browser.ask("GET /api/jobs/" + job + "/cancel", bearer).status == 405);
  CHECK(nlohmann::json::parse(browser.get("/api/jobs/" + job).body)["state"] != "cancelled");
  CHECK(browser.ask(cancel, bearer).status == 200);
  CHECK(nlohmann::json::parse(browser.get("/api/jobs/" + job).body)["state"] == "cancelled");
  CHECK(browser.ask(cancel, bearer).status == 409);
}

TEST_CASE("what is too long is refused before it is read, and nonsense is hung up on") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--http", "127.0.0.1:*"});
  const Browser browser(farm.up().out());
  const std::string host = "Host: 127.0.0.1:" + std::to_string(browser.port()) + "\r\n";
  // The body that is announced isn't sent: the answer doesn't wait for it.
  WebConnection announcing(browser.port());
  announcing.send("POST / HTTP/1.1\r\n" + host + "Content-Length: 65537\r\n\r\n");
  CHECK(announcing.read_to_end().starts_with("HTTP/1.1 413 "));
  CHECK(browser.ask("POST /", "", std::string(65536, 'x')).status == 401);
  CHECK(browser.ask("POST /", "", std::string(10'000'000, 'x')).status == 413);
  CHECK(browser.get("/", "X-Long: " + std::string(9000, 'x') + "\r\n").status == 431);
  WebConnection nonsense(browser.port());
  nonsense.send("hello\r\n\r\n");
  CHECK(nonsense.read_to_end().starts_with("HTTP/1.1 400 "));
  CHECK(browser.get("/").status == 200);
}

/// Sends a byte of a request over each connection, again and again, until it ends.
class Dripping {
 public:
  Dripping(std::uint16_t port, int connections) {
    for (int i = 0; i < connections; ++i) connections_.emplace_back(port);
    thread_ = std::jthread([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        for (WebConnection& c : connections_) c.send("a");
        std::this_thread::sleep_for(1s);
      }
    });
  }

 private:
  std::vector<WebConnection> connections_;
  std::jthread thread_;
};

TEST_CASE("slow and idle connections hold nobody up: the page answers as often as it is asked") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--http", "127.0.0.1:*"});
  const Browser browser(farm.up().out());
  // More than the server holds, too.
  for (const int connections : {200, 1000}) {
    const Dripping slow(browser.port(), connections);
    int answers = 0;
    for (int i = 0; i < 50; ++i) answers += browser.get("/api/jobs").status == 200;
    CHECK(answers == 50);
  }
  CHECK(lines_of(ok(sandbox, {"nodes"})).size() == 5);
  ok(sandbox, {"down"});
  CHECK(farm.up().wait(10s).status == 0);
}

}  // namespace
}  // namespace graycube

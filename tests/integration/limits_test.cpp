// Farms under limits of the system (ulimit).
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "integration/farm.hpp"

namespace graycube {
namespace {

/// Runs the command under limits that `ulimit` sets.
Outcome run_under(Sandbox& sandbox, const std::string& limits, const std::string& arguments) {
  return sandbox.run_program(
      "/bin/sh", {"-c", limits + "; exec " + std::string(GRAYCUBE_COMMAND) + " " + arguments});
}

TEST_CASE("whatever ulimit -n says, a farm has as many descriptors as the system lets it") {
  Sandbox sandbox;
  const std::string scene = scene_file("first.json").string();
  const Outcome low =
      run_under(sandbox, "ulimit -Sn 40", "render " + scene + " -n 64 --size 64x64 -o low.exr -q");
  INFO(low.err);
  CHECK(low.status == 0);
  CHECK(sandbox.run({"render", scene, "-n", "64", "--size", "64x64", "-o", "usual.exr", "-q"})
            .status == 0);
  CHECK((file_bytes(sandbox / "low.exr") == file_bytes(sandbox / "usual.exr")));
}

TEST_CASE("a farm that doesn't fit is refused with what it needs, and leaves nothing behind") {
  Sandbox sandbox;
  const std::string scene = scene_file("first.json").string();
  const Outcome o = run_under(sandbox, "ulimit -n 100", "render " + scene + " -n 64 -o a.exr -q");
  CHECK(o.status == 1);
  CHECK(o.err.find("64 nodes need 128 open files and sockets, and the system lets a process have "
                   "100 (ulimit -Hn)") != std::string::npos);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.files().empty());
}

/// Connections to a local socket that say nothing; closed at the end.
class SilentPeers {
 public:
  SilentPeers(const std::string& path, int most) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.data(), path.size());
    for (int i = 0; i < most; ++i) {
      // Without waiting: those that nobody accepts fill the listener's queue.
      const int s = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
      sockets_.push_back(s);
      if (::connect(s, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return;
    }
  }
  ~SilentPeers() {
    for (const int s : sockets_) ::close(s);
  }
  SilentPeers(const SilentPeers&) = delete;
  SilentPeers& operator=(const SilentPeers&) = delete;

  /// How many of them the farm has closed.
  std::ptrdiff_t closed() const {
    return std::ranges::count_if(sockets_, [](int s) {
      // Whoever is let in is greeted, which is read first.
      std::array<char, 256> greeting;
      ssize_t got = 0;
      while ((got = ::recv(s, greeting.data(), greeting.size(), 0)) > 0) {
      }
      return got == 0 || errno == ECONNRESET;
    });
  }

 private:
  std::vector<int> sockets_;
};

nlohmann::json nodes_once_all_are_here(Sandbox& sandbox, const std::string& endpoint) {
  const auto until = std::chrono::steady_clock::now() + 20s;
  std::string last;
  do {
    const Outcome o = sandbox.run({"nodes", "--json", "--connect", endpoint});
    last = o.out + o.err;
    if (o.status == 0) {
      const auto nodes = nlohmann::json::parse(o.out);
      const bool are_here = std::all_of(nodes.begin(), nodes.end(),
                                        [](const auto& n) { return n["state"] == "idle"; });
      if (are_here) return nodes;
    }
    std::this_thread::sleep_for(20ms);
  } while (std::chrono::steady_clock::now() < until);
  FAIL("not all nodes are there: " << last);
  return {};
}

TEST_CASE("a farm that is out of descriptors goes on, and replaces its nodes when it has some") {
  Sandbox sandbox;
  const std::string path = (sandbox / "farm").string(), endpoint = "ipc://" + path;
  // In the background, with a limit that ends it should this test fail.
  const std::string up =
      std::string("setsid timeout 200 ") + GRAYCUBE_COMMAND + " up -n 4 --listen ";
  const std::string line = "ulimit -n 100; " + up + endpoint + " > up.log 2>&1 &";
  REQUIRE(sandbox.run_program("/bin/sh", {"-c", line}).status == 0);
  const nlohmann::json before = nodes_once_all_are_here(sandbox, endpoint);
  {
    const SilentPeers peers(path, 120);
    std::this_thread::sleep_for(300ms);
    ::kill(before[0]["pid"], SIGKILL);
    std::this_thread::sleep_for(300ms);
  }
  const nlohmann::json after = nodes_once_all_are_here(sandbox, endpoint);
  CHECK(after[0]["pid"] != before[0]["pid"]);
  CHECK(after[1]["pid"] == before[1]["pid"]);
  CHECK(sandbox.run({"down", "--connect", endpoint}).status == 0);
}

TEST_CASE("clients' connections beyond a number are closed, and nodes' are not") {
  rlimit files{};
  ::getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &files);
  constexpr int kBatches = 40, kBatch = 40;  // 1600: more than 1024, and what a frontal has besides
  REQUIRE(files.rlim_max > 2 * kBatches * kBatch);
  Sandbox sandbox;
  const std::string path = (sandbox / "farm").string(), endpoint = "ipc://" + path;
  Running up = sandbox.start({"up", "-n", "2", "--listen", endpoint});
  up.wait_for("graycube down");
  const nlohmann::json before = nodes_once_all_are_here(sandbox, endpoint);
  {
    std::vector<std::unique_ptr<SilentPeers>> peers;
    for (int batch = 0; batch < kBatches; ++batch) {
      peers.push_back(std::make_unique<SilentPeers>(path, kBatch));
      std::this_thread::sleep_for(20ms);
    }
    ::kill(before[0]["pid"], SIGKILL);
    const auto until = std::chrono::steady_clock::now() + 30s;
    while (up.err().find("has taken its place") == std::string::npos) {
      REQUIRE(std::chrono::steady_clock::now() < until);
      std::this_thread::sleep_for(20ms);
    }
    std::ptrdiff_t closed = 0;
    for (const auto& p : peers) closed += p->closed();
    CHECK(closed > 0);
    CHECK(closed <= kBatches * kBatch - 1024);
  }
  nodes_once_all_are_here(sandbox, endpoint);
  CHECK(up.err().find("beyond the 1024 that clients may have") != std::string::npos);
  CHECK(sandbox.run({"down", "--connect", endpoint}).status == 0);
}

}  // namespace
}  // namespace graycube

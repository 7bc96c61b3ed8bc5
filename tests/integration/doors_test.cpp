// Who gets into a farm: its own processes, and its user's commands.
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "catch.hpp"
#include "integration/farm.hpp"
#include "proto/control.hpp"
#include "transport/farm_key.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

std::string first() { return scene_file("first.json").string(); }

nlohmann::json nodes_of(Sandbox& sandbox) {
  return nlohmann::json::parse(ok(sandbox, {"nodes", "--json"}));
}

/// The endpoint of a node's inbox, once the node has said hello.
std::string endpoint_of_node(Sandbox& sandbox, std::size_t rank) {
  const auto until = std::chrono::steady_clock::now() + 30s;
  do {
    const std::string endpoint = nodes_of(sandbox).at(rank)["endpoint"];
    if (!endpoint.empty()) return endpoint;
    std::this_thread::sleep_for(20ms);
  } while (std::chrono::steady_clock::now() < until);
  FAIL("node " << rank << " doesn't start");
  return "";
}

fs::path path_of(const std::string& endpoint) { return endpoint.substr(6); }

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  REQUIRE(::lstat(path.c_str(), &status) == 0);
  return status.st_mode & 0777;
}

/// What `graycube up` says between two texts.
std::string said_between(Farm& farm, const std::string& before, const std::string& after) {
  const std::string said = farm.up().out();
  const std::size_t begin = said.find(before);
  REQUIRE(begin != std::string::npos);
  const std::size_t from = begin + before.size();
  return said.substr(from, said.find(after, from) - from);
}

TEST_CASE("a farm's sockets and their folders are its owner's alone, whatever the umask") {
  Sandbox sandbox;
  const mode_t before = ::umask(0);
  Farm farm(sandbox);
  ::umask(before);
  const fs::path node = path_of(endpoint_of_node(sandbox, 0));
  const fs::path clients = said_between(farm, "ipc://", ";");
  for (const fs::path& socket : {node, node.parent_path() / "nodes", clients}) {
    INFO(socket);
    CHECK(mode_of(socket) == 0600);
    CHECK(mode_of(socket.parent_path()) == 0700);
  }
}

TEST_CASE("what says hello without the secret is no node, and the log tells of it") {
  Sandbox sandbox;
  Farm farm(sandbox);
  const std::string node = endpoint_of_node(sandbox, 0);
  const fs::path clients = said_between(farm, "ipc://", ";");
  control::Hello hello;
  hello.rank = 0;
  hello.pid = 1;
  hello.endpoint = node;
  ZmqContext context;
  Connection by_clients(context, "ipc://" + clients.string());
  Connection by_nodes(context, "ipc://" + (path_of(node).parent_path() / "nodes").string());
  // The first nodes that a farm starts have small start numbers.
  for (hello.incarnation = 1; hello.incarnation <= 4; ++hello.incarnation) {
    by_clients.send(Message::of_text(encode(hello)));
    by_nodes.send(Message::of_text(encode(hello), Bytes(32, std::byte{0})));
  }
  const auto until = std::chrono::steady_clock::now() + 30s;
  const std::string told = "a hello for node 0: it came without the farm's secret";
  while (farm.up().err().find(told) == std::string::npos) {
    REQUIRE(std::chrono::steady_clock::now() < until);
    std::this_thread::sleep_for(20ms);
  }
  CHECK_FALSE(by_nodes.receive(300ms));
  for (const auto& n : nodes_of(sandbox)) CHECK(n["pid"] != 1);
  const std::string job = submit(sandbox, {first(), "--size", "64x48", "--algorithm", "macro"});
  ok(sandbox, {"watch", job});
  CHECK(ok(sandbox, {"status", job}).find("state: done\n") != std::string::npos);
}

TEST_CASE("the secret stands neither on command lines nor in environments") {
  Sandbox sandbox;
  Farm farm(sandbox);
  for (std::size_t rank = 0; rank < 4; ++rank) endpoint_of_node(sandbox, rank);
  for (const auto& node : nodes_of(sandbox)) {
    const std::string folder = "/proc/" + std::to_string(node["pid"].get<int>());
    for (const char* file : {"/cmdline", "/environ"})
      CHECK(file_bytes(folder + file).find("secret") == std::string::npos);
    // What is inherited is closed once it is read.
    for (const auto& fd : fs::directory_iterator(folder + "/fd")) {
      std::error_code ignored;
      CHECK(fs::read_symlink(fd, ignored).string().find("secret") == std::string::npos);
    }
  }
}

TEST_CASE("a node can't be started by anybody but a frontal") {
  Sandbox sandbox;
  const fs::path node = fs::path(GRAYCUBE_COMMAND).parent_path() / "graycube-node";
  const Outcome o =
      sandbox.run_program(node.string(), {"--rank", "0", "--incarnation", "1", "--frontal",
                                          "ipc:///tmp/x", "--folder", sandbox.work().string()});
  CHECK(o.status == 2);
  CHECK(o.err.find("nodes are started by graycube-frontal") != std::string::npos);
}

TEST_CASE("at a TCP port the user's commands find the key, and nothing goes without it") {
  Sandbox sandbox;
  Farm farm(sandbox, {"--listen", "tcp://127.0.0.1:*"});
  const std::string endpoint = said_between(farm, " at ", ";");
  const std::string key = said_between(farm, "key in ", "\n");
  CHECK(mode_of(key) == 0600);
  ok(sandbox, {"nodes", "--connect", endpoint});
  const std::string text = file_bytes(key);
  const std::string moved = (sandbox / "key").string();
  fs::rename(key, moved);
  const Outcome without = sandbox.run({"nodes", "--connect", endpoint});
  CHECK(without.status == 1);
  CHECK(without.err.find("its key can't be read: " + key) != std::string::npos);
  ok(sandbox, {"nodes", "--connect", endpoint, "--key", moved});
  const CurveAccess access = access_of_client(read_client_keys(moved));
  const CurvePair another = pair_of(make_secret());
  ZmqContext context;
  Connection stranger(context, endpoint, CurveAccess{another, access.server});
  Connection lost(context, endpoint, CurveAccess{access.own, another.public_key});
  for (Connection* c : {&stranger, &lost}) {
    c->send(Message::of_text(encode(control::Down{})));
    CHECK_FALSE(c->receive(500ms));
  }
  farm.up().wait_for("without the farm's key: it has another key");
  ok(sandbox, {"down", "--connect", endpoint, "--key", moved});
  CHECK(farm.up().wait(10s).status == 0);
  CHECK(sandbox.temporary_files().empty());
}

/// A key file that 'graycube key' makes.
std::string key_file(Sandbox& sandbox, const std::string& name, const Arguments& options = {}) {
  Arguments arguments{"key"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const fs::path file = sandbox.write(name, ok(sandbox, arguments));
  REQUIRE(::chmod(file.c_str(), 0600) == 0);
  return file.string();
}

TEST_CASE("a client's key is enough for a client, and no farm begins with it") {
  Sandbox sandbox;
  const std::string key = key_file(sandbox, "farm.key");
  const std::string client = key_file(sandbox, "client.key", {"--client", key});
  Farm farm(sandbox, {"--listen", "tcp://127.0.0.1:*", "--key", key});
  const std::string endpoint = said_between(farm, " at ", ";");
  ok(sandbox, {"nodes", "--connect", endpoint, "--key", client});
  const Outcome second = sandbox.run({"up", "--listen", "tcp://127.0.0.1:*", "--key", client});
  CHECK(second.status == 1);
  CHECK(second.err.find("it is a client's key, and a farm's is needed") != std::string::npos);
  const Outcome nested = sandbox.run({"key", "--client", client});
  CHECK(nested.err.find("it is a client's key, and a farm's is needed") != std::string::npos);
  ok(sandbox, {"down", "--connect", endpoint, "--key", key});
  CHECK(farm.up().wait(10s).status == 0);
  // What the user has made stays.
  CHECK(fs::exists(key));
}

TEST_CASE("commands with a key that opens nothing say so at once") {
  Sandbox sandbox;
  const std::string key = key_file(sandbox, "farm.key"), other = key_file(sandbox, "other.key");
  Farm farm(sandbox, {"--listen", "tcp://127.0.0.1:*", "--key", key});
  const std::string endpoint = said_between(farm, " at ", ";");
  const auto problem_with = [&](const std::string& file) {
    // Far less than the wait for a farm that is slow.
    const Outcome o = sandbox.run({"nodes", "--connect", endpoint, "--key", file}, 20s);
    CHECK(o.status == 1);
    return o.err;
  };
  CHECK(problem_with(other).find("it is another farm than this key's, or none") !=
        std::string::npos);
  const std::string open = key_file(sandbox, "open.key");
  REQUIRE(::chmod(open.c_str(), 0640) == 0);
  CHECK(problem_with(open).find("expected a file of this user that nobody else may read") !=
        std::string::npos);
  CHECK(problem_with((sandbox / "none.key").string()).find("No such file") != std::string::npos);
  ok(sandbox, {"nodes", "--connect", endpoint, "--key", key});
}

TEST_CASE("off the loopback there is no farm without a key") {
  Sandbox sandbox;
  for (const char* endpoint : {"tcp://0.0.0.0:*", "tcp://*:7411", "tcp://192.0.2.1:7411"}) {
    const Outcome o = sandbox.run({"up", "--listen", endpoint});
    CHECK(o.status == 2);
    CHECK(o.err.find("need a key: --key FILE") != std::string::npos);
  }
  const Outcome o = sandbox.run({"nodes", "--connect", "tcp://192.0.2.1:7411"});
  CHECK(o.status == 2);
  CHECK(o.err.find("need a key: --key FILE") != std::string::npos);
}

TEST_CASE("commands send nothing to a socket that somebody else may have made") {
  Sandbox sandbox;
  const fs::path folder = sandbox / "open";
  fs::create_directory(folder);
  REQUIRE(::chmod(folder.c_str(), 0777) == 0);
  const Outcome open = sandbox.run({"nodes", "--connect", "ipc://" + (folder / "farm").string()});
  CHECK(open.status == 1);
  CHECK(open.err.find("others may put sockets into it; nothing was sent there") !=
        std::string::npos);
  if (::geteuid() != 0) return;
  // Only root can give files away.
  const fs::path foreign = sandbox / "foreign";
  fs::create_directory(foreign);
  ZmqContext context;
  const Inbox trap(context, "ipc://" + (foreign / "farm").string());
  REQUIRE(::chown((foreign / "farm").c_str(), 12345, 12345) == 0);
  const Outcome theirs = sandbox.run({"nodes", "--connect", trap.endpoint()});
  CHECK(theirs.status == 1);
  CHECK(theirs.err.find("another user's (user id 12345); nothing was sent there") !=
        std::string::npos);
  REQUIRE(::chown(foreign.c_str(), 12345, 12345) == 0);
  CHECK(sandbox.run({"nodes", "--connect", trap.endpoint()}).err.find("another user's folder") !=
        std::string::npos);
}

}  // namespace
}  // namespace graycube

#include "frontal/parts/node_door.hpp"

#include "catch.hpp"

namespace graycube {
namespace {

control::Hello hello_from(const std::string& endpoint) {
  control::Hello hello;
  hello.endpoint = endpoint;
  return hello;
}

TEST_CASE("a node belongs to the farm if it shows the secret and listens in the farm's folder") {
  Secret secret{};
  secret[3] = std::byte{7};
  const NodeDoor door(secret);
  const std::string folder = "/tmp/farm";
  const control::Hello hello = hello_from("ipc:///tmp/farm/node-3");
  CHECK(door.problem_of(hello, secret, folder) == nullptr);
  CHECK(door.problem_of(hello, secret, std::nullopt) != nullptr);
  CHECK(door.problem_of(hello, {}, folder) != nullptr);
  CHECK(door.problem_of(hello, Secret{}, folder) != nullptr);
  for (const char* elsewhere :
       {"", "ipc:///tmp/farm/", "ipc:///tmp/farm", "ipc:///tmp/farm/../other/node-3",
        "ipc:///tmp/farm/..", "ipc:///tmp/farm2/node-3", "tcp://127.0.0.1:5555",
        "tcp://198.51.100.1:80"}) {
    INFO(elsewhere);
    CHECK(door.problem_of(hello_from(elsewhere), secret, folder) != nullptr);
  }
}

TEST_CASE("a farm without a secret, as in simulations, takes all nodes") {
  CHECK(NodeDoor(std::nullopt).problem_of(hello_from("3"), {}, {}) == nullptr);
}

}  // namespace
}  // namespace graycube

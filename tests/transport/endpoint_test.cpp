#include "transport/endpoint.hpp"

#include "catch.hpp"
#include "transport/own_address.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {
namespace {

TEST_CASE("off the loopback an endpoint needs a key, and on it none") {
  for (const char* endpoint : {"tcp://127.0.0.1:5555", "tcp://[::1]:*", "tcp://localhost:1"}) {
    CHECK_FALSE(endpoint_problem(endpoint));
    CHECK(is_on_loopback(endpoint));
  }
  for (const char* endpoint : {"tcp://10.0.0.3:5555", "tcp://*:7411", "tcp://0.0.0.0:7411",
                               "tcp://[fd00::3]:7411", "tcp://render-1.example:7411"}) {
    INFO(endpoint);
    REQUIRE(endpoint_problem(endpoint));
    CHECK(endpoint_problem(endpoint)->find("need a key") != std::string::npos);
    CHECK_FALSE(endpoint_problem(endpoint, true));
    CHECK_FALSE(is_on_loopback(endpoint));
  }
}

TEST_CASE("what is no endpoint is none with a key either") {
  for (const char* endpoint : {"tcp://10.0.0.3", "tcp://:5555", "tcp://10.0.0.3:0", "tcp://a b:5",
                               "tcp://[]:5", "udp://10.0.0.3:5", "ipc://relative", ""}) {
    INFO(endpoint);
    CHECK(endpoint_problem(endpoint, true));
  }
}

TEST_CASE("a machine's own address is that of the way to another") {
  CHECK(own_address_towards("tcp://127.0.0.1:5555") == "127.0.0.1");
  CHECK_THROWS_AS(own_address_towards("tcp://no.such.host.invalid:5555"), TransportError);
}

}  // namespace
}  // namespace graycube

#include "integration/farm.hpp"

#include <thread>

#include "catch.hpp"

namespace graycube {
namespace {

Running start(Sandbox& sandbox, const Arguments& options) {
  Arguments arguments{"up", "-n", "4"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return sandbox.start(arguments);
}

}  // namespace

Farm::Farm(Sandbox& sandbox, const Arguments& options) : up_(start(sandbox, options)) {
  up_.wait_for("graycube down");
}

std::string ok(Sandbox& sandbox, const Arguments& arguments) {
  const Outcome o = sandbox.run(arguments);
  INFO(arguments.front() << ": " << o.out << o.err);
  REQUIRE(o.status == 0);
  return o.out;
}

std::string submit(Sandbox& sandbox, Arguments options) {
  options.insert(options.begin(), "submit");
  const std::string out = ok(sandbox, options);
  REQUIRE(out.find_first_not_of("0123456789") == out.size() - 1);
  return out.substr(0, out.size() - 1);
}

void wait_for_state(Sandbox& sandbox, const std::string& job, const std::string& state) {
  const auto until = std::chrono::steady_clock::now() + 30s;
  std::string last;
  do {
    last = nlohmann::json::parse(ok(sandbox, {"status", job, "--json"}))["state"];
    if (last == state) return;
    std::this_thread::sleep_for(20ms);
  } while (std::chrono::steady_clock::now() < until);
  FAIL("job " << job << " is " << last << ", not " << state);
}

}  // namespace graycube

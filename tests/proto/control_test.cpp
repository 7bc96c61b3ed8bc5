#include "proto/control.hpp"

#include <limits>
#include <stdexcept>

#include "catch.hpp"
#include "fuzz/proto_fuzz.hpp"
#include "proto/control_examples.hpp"
#include "proto/random.hpp"

using namespace graycube;
using namespace graycube::test;

namespace {

ControlError error_of(std::string_view text) {
  const ControlResult result = decode(text);
  INFO(text);
  REQUIRE(std::holds_alternative<ControlError>(result));
  return std::get<ControlError>(result);
}

ControlMessage message_of(std::string_view text) {
  ControlResult result = decode(text);
  if (const auto* error = std::get_if<ControlError>(&result))
    FAIL(text << ": " << error->field << ": " << error->why);
  return std::get<ControlMessage>(result);
}

/// The text with one to three characters replaced, inserted or removed; characters that have a
/// meaning in JSON are likely.
std::string scribbled(std::string text, Random& random) {
  static constexpr std::string_view kInk = "0123456789.-eE\"\"{}[],:\\ tu\xC3\x01";
  for (std::uint64_t n = 1 + random.below(3); n > 0 && !text.empty(); --n) {
    const std::size_t at = random.below(text.size());
    const char ink = kInk[random.below(kInk.size())];
    switch (random.below(3)) {
      case 0: text[at] = ink; break;
      case 1: text.insert(at, 1, ink); break;
      default: text.erase(at, 1); break;
    }
  }
  return text;
}

std::string nested(std::size_t depth) {
  return R"({"graycube":1,"type":"list","x":)" + std::string(depth, '[') + std::string(depth, ']') +
         "}";
}

}  // namespace

TEST_CASE("there is an example of every message, and each comes back equal") {
  const std::vector<ControlMessage> examples = example_messages();
  REQUIRE(examples.size() == std::variant_size_v<ControlMessage>);
  for (std::size_t i = 0; i < examples.size(); ++i) {
    INFO(encode(examples[i]));
    REQUIRE(examples[i].index() == i);
    CHECK(message_of(encode(examples[i])) == examples[i]);
    CHECK(type_of(examples[i]) == control_types()[i]);
  }
}

TEST_CASE("a message begins with the version and its type") {
  CHECK(encode(control::EpochAck{7, 2}) ==
        R"({"graycube":1,"type":"epoch_ack","job":7,"epoch":2})");
  CHECK(encode(control::Goodbye{}) == R"({"graycube":1,"type":"goodbye"})");
}

TEST_CASE("another version, or none, is refused") {
  CHECK(error_of(R"({"graycube":2,"type":"list"})") == ControlError{"graycube", "unknown version"});
  CHECK(error_of(R"({"graycube":"1","type":"list"})").field == "graycube");
  CHECK(error_of(R"({"type":"list"})") == ControlError{"graycube", "missing"});
}

TEST_CASE("an unknown type, or none, is refused") {
  CHECK(error_of(R"({"graycube":1,"type":"lists"})") == ControlError{"type", "unknown"});
  CHECK(error_of(R"({"graycube":1,"type":7})").field == "type");
  CHECK(error_of(R"({"graycube":1})") == ControlError{"type", "missing"});
}

TEST_CASE("unknown fields are ignored") {
  CHECK(message_of(R"({"graycube":1,"type":"status","job":4,"colour":{"of":["money"]}})") ==
        ControlMessage(control::Status{4}));
}

TEST_CASE("text that isn't a JSON object is refused") {
  for (const char* text :
       {"", "{", "[]", "null", "\"graycube\"", "{\"graycube\":1,}", "{\"graycube\":1}x", "\xFF\xFE",
        "{\"graycube\":1,\"type\":\"\xC3\"}", "{'graycube':1}",
        "{\"graycube\":1,\"type\":\"ping\",\"sequence\":1e999}"}) {
    CHECK(error_of(text).why == "not a JSON object");
  }
}

TEST_CASE("an error names the field, however deep") {
  CHECK(error_of(R"({"graycube":1,"type":"submit","scene_name":"a","options":{"width":0}})") ==
        ControlError{"options/width", "out of range"});
  CHECK(error_of(R"({"graycube":1,"type":"submit","scene_name":"a","options":{"grain":"sand"}})") ==
        ControlError{"options/grain", "must be one of pixel, line, tile"});
  CHECK(error_of(R"({"graycube":1,"type":"start","job":1,"epoch":0,"incarnations":[1,2,-3]})") ==
        ControlError{"incarnations/2", "out of range"});
  CHECK(error_of(
            R"({"graycube":1,"type":"failed","job":1,"code":"busy","errors":[{"where":"a"}]})") ==
        ControlError{"errors/0/why", "missing"});
}

TEST_CASE("integers beyond their field are refused, not wrapped") {
  const auto epoch_ack = [](const std::string& epoch) {
    return R"({"graycube":1,"type":"epoch_ack","job":1,"epoch":)" + epoch + "}";
  };
  CHECK(message_of(epoch_ack("4294967295")) == ControlMessage(control::EpochAck{1, 4294967295u}));
  CHECK(message_of(epoch_ack("3.0")) == ControlMessage(control::EpochAck{1, 3}));
  for (const char* epoch :
       {"4294967296", "-1", "18446744073709551616", "1e30", "-1e30", "1.8446744073709552e19"}) {
    CHECK(error_of(epoch_ack(epoch)) == ControlError{"epoch", "out of range"});
  }
  CHECK(error_of(epoch_ack("1.5")) == ControlError{"epoch", "must be an integer"});
  CHECK(error_of(epoch_ack("true")) == ControlError{"epoch", "must be an integer"});
  CHECK(error_of(epoch_ack("null")) == ControlError{"epoch", "must be an integer"});
}

TEST_CASE("options that a client leaves out keep their defaults") {
  CHECK(message_of(R"({"graycube":1,"type":"submit","scene_name":"a","options":{}})") ==
        ControlMessage(control::Submit{"a", {}}));
}

TEST_CASE("fields that must fit together are checked together") {
  using namespace control;
  const auto example_load = [] {
    for (const ControlMessage& m : example_messages()) {
      if (const auto* load = std::get_if<Load>(&m)) return *load;
    }
    throw std::logic_error("no example of load");
  };
  Load load = example_load();
  load.algorithm = Algorithm::kAuto;
  CHECK(error_of(encode(load)).field == "algorithm");
  load = example_load();
  load.grid.column_edges = {1, 2};
  CHECK(error_of(encode(load)).field == "grid/column_edges");
  load.grid.column_edges = {1, 2, 2};
  CHECK(error_of(encode(load)).field == "grid/column_edges");
  load.grid.column_edges = {1, 2, 3};
  load.grid.scatter = 4;
  CHECK(error_of(encode(load)).field == "grid/scatter");
  load = example_load();
  load.grid.own_edges.pop_back();
  CHECK(error_of(encode(load)).field == "grid/own_edges");
  load.grid.own_edges = {8, 16, 40, 4, 20, 20};
  CHECK(error_of(encode(load)).field == "grid/own_edges");
  load.grid.own_edges.clear();
  for (const std::vector<double>& depths :
       {std::vector<double>{0}, std::vector<double>{1, 1}, std::vector<double>{2, 1}}) {
    load.grid.slab_depths = depths;
    CHECK(error_of(encode(load)).field == "grid/slab_depths");
  }
  load.grid.slab_depths = {0.1, 1.0 / 3, 1e300};
  CHECK(message_of(encode(load)) == ControlMessage(load));
  CHECK(error_of(encode(Welcome{3, "v", {"a", "b"}, 100})).field == "endpoints");
  CHECK(error_of(encode(Picture{1, 10, 10, 5, 6})).field == "rows");
  CHECK(error_of(encode(Picture{1, 16384, 4096, 0, 4096})).field == "rows");
  CHECK(error_of(encode(Jobs{{JobInfo{.job = 1, .tiles = 2, .tiles_whole = 3}}})).field ==
        "jobs/0/tiles_whole");
  CHECK(error_of(encode(Progress{.job = 1, .tiles_whole = 1})).field == "tiles_whole");
}

TEST_CASE("messages too long or nested too deeply are refused before they are parsed") {
  CHECK(error_of(std::string(kMaxControlBytes + 1, ' ')).why ==
        "longer than a control message may be");
  CHECK(message_of(nested(kMaxControlNesting - 1)).index() == message_of(nested(0 + 1)).index());
  CHECK(error_of(nested(kMaxControlNesting)).why == "nested too deeply");
  CHECK(error_of(std::string(kMaxControlBytes, '[')).why == "nested too deeply");
  // Brackets within strings don't count.
  CHECK(message_of(
            R"({"graycube":1,"type":"list","x":"\"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[["})") ==
        ControlMessage(control::List{}));
}

TEST_CASE("strings and arrays longer than their fields are refused") {
  const auto node_error = [](const std::string& message) {
    return R"({"graycube":1,"type":"node_error","job":1,"message":")" + message + "\"}";
  };
  CHECK(std::holds_alternative<control::NodeError>(
      message_of(node_error(std::string(kMaxTextBytes, 'x')))));
  CHECK(error_of(node_error(std::string(kMaxTextBytes + 1, 'x'))).field == "message");
  CHECK(error_of(node_error("\\u001b[2J")) == ControlError{"message", "control characters"});
  std::string incarnations = "0";
  for (std::uint32_t i = 0; i < kMaxNodes; ++i) incarnations += ",0";
  CHECK(error_of(R"({"graycube":1,"type":"start","job":1,"epoch":0,"incarnations":[)" +
                 incarnations + "]}") == ControlError{"incarnations", "more than 1024 elements"});
}

TEST_CASE("whatever text a message carries, it goes out printable and short enough") {
  const auto sent = [](const std::string& text) {
    return std::get<control::NodeError>(message_of(encode(control::NodeError{1, 0, text}))).message;
  };
  CHECK(sent("tab\tnewline\nescape\x1b[2J") == "tab newline escape [2J");
  CHECK(sent("latin1 \xE9 cut \xC3") == "latin1 ? cut ?");
  CHECK(sent("overlong \xC0\xAF surrogate \xED\xA0\x80") == "overlong ?? surrogate ???");
  CHECK(sent("é 図 😀 \xF4\x8F\xBF\xBF") == "é 図 😀 \xF4\x8F\xBF\xBF");
  // Cut between characters: 1023 bytes, then one of two.
  CHECK(sent(std::string(1023, 'x') + "é") == std::string(1023, 'x'));
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    std::string text(random.below(1500), ' ');
    for (char& c : text) c = static_cast<char>(random.bits());
    CHECK(sent(text).size() <= kMaxTextBytes);
  }
}

TEST_CASE("the longest lists fit in one message") {
  const std::string name(2 * kMaxNameBytes, '"'), text(2 * kMaxTextBytes, '\\');
  control::JobInfo job = example_job();
  job.scene = name;
  job.message = text;
  job.eta_s = job.fraction = 1.0 / 3;
  CHECK(std::holds_alternative<control::Jobs>(
      message_of(encode(control::Jobs{std::vector(kMaxJobsListed, job)}))));
  control::Failed failed{1, FailureCode::kBadInput,
                         std::vector(kMaxErrorsListed, control::ErrorItem{text, text})};
  CHECK(std::holds_alternative<control::Failed>(message_of(encode(failed))));
  const control::NodeInfo node{1023, 1023, ~0ull, NodeState::kStarting, name, 1024};
  CHECK(std::holds_alternative<control::NodeList>(
      message_of(encode(control::NodeList{std::vector(kMaxNodes, node)}))));
  CHECK(std::holds_alternative<control::Welcome>(
      message_of(encode(control::Welcome{kMaxNodes, name, std::vector(kMaxNodes, name), 1}))));
}

TEST_CASE("an estimate that isn't finite is left out") {
  control::Progress progress{.job = 1};
  progress.eta_s = std::numeric_limits<double>::infinity();
  CHECK_FALSE(std::get<control::Progress>(message_of(encode(progress))).eta_s);
}

TEST_CASE("a job's statistics keep their text, order included") {
  const std::string text = R"({"z":1,"a":[0.1,-2e+30],"m":{"b":null,"a":"é"}})";
  const auto done = std::get<control::Done>(message_of(encode(control::Done{1, {text}})));
  CHECK(done.stats.text == text);
}

TEST_CASE("messages cut anywhere are refused") {
  for (const ControlMessage& message : example_messages()) {
    const std::string text = encode(message);
    for (std::size_t size = 0; size < text.size(); ++size) {
      CHECK_FALSE(fuzz_control(std::string_view(text).substr(0, size)));
    }
  }
}

TEST_CASE("mutated messages are refused or survive a round trip") {
  int accepted = 0;
  const std::vector<ControlMessage> examples = example_messages();
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    for (const ControlMessage& message : examples) {
      INFO("seed " << seed << ", " << type_of(message));
      const std::string text = encode(message);
      const auto bytes = std::as_bytes(std::span(text));
      const auto changed = mutated({bytes.begin(), bytes.end()}, random);
      accepted +=
          fuzz_control({reinterpret_cast<const char*>(changed.data()), changed.size()}) ? 1 : 0;
      accepted += fuzz_control(scribbled(text, random)) ? 1 : 0;
    }
  }
  CHECK(accepted > 250);
}

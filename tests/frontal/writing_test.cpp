// Which clients may have the frontal write files.

#include "catch.hpp"
#include "frontal/frontal.hpp"
#include "proto/control.hpp"

using namespace graycube;

namespace {

/// The answer of a frontal that has no job to a request.
control::Failed refusal(bool is_private, const ControlMessage& request) {
  const auto store = make_memory_store();
  Frontal frontal({.cube = *Hypercube::of_size(2), .version = "test", .is_private = is_private},
                  *store);
  const Message message = Message::of_text(encode(request));
  frontal.on_message("client", message);
  for (const Frontal::Outgoing& o : frontal.take_outgoing()) {
    if (o.to != "client") continue;
    const auto decoded = decode(o.message.text());
    const auto* answer = std::get_if<ControlMessage>(&decoded);
    REQUIRE(answer != nullptr);
    REQUIRE(std::holds_alternative<control::Failed>(*answer));
    return std::get<control::Failed>(*answer);
  }
  FAIL("no answer");
  return {};
}

}  // namespace

TEST_CASE("only a private frontal writes files") {
  const control::Failed failed = refusal(false, control::Write{1, "/nowhere/a.exr", ""});
  CHECK(failed.code == FailureCode::kBadRequest);
  CHECK(failed.errors.front().why == "only a private frontal writes files");
}

TEST_CASE("a picture that isn't there is not written") {
  CHECK(refusal(true, control::Write{1, "/nowhere/a.exr", ""}).code == FailureCode::kUnknownJob);
}

#include "transport/secret.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "catch.hpp"

namespace graycube {
namespace {

TEST_CASE("each farm has a secret of its own") { CHECK(make_secret() != make_secret()); }

TEST_CASE("a secret is the same only if all of its bytes are") {
  const Secret secret = make_secret();
  CHECK(is_same_secret(secret, secret));
  for (const std::size_t at : {std::size_t{0}, std::size_t{17}, secret.size() - 1}) {
    Secret other = secret;
    other[at] ^= std::byte{1};
    CHECK_FALSE(is_same_secret(other, secret));
  }
  CHECK_FALSE(is_same_secret({}, secret));
  CHECK_FALSE(is_same_secret(std::span(secret).first(31), secret));
}

TEST_CASE("a secret's digits read back, and nothing else is read as one") {
  const Secret secret = make_secret();
  const std::string text = hex_of(secret);
  CHECK(text.size() == 64);
  CHECK(secret_of_hex(text) == secret);
  CHECK_FALSE(secret_of_hex(""));
  CHECK_FALSE(secret_of_hex(text + "0"));
  CHECK_FALSE(secret_of_hex(text.substr(2)));
  CHECK_FALSE(secret_of_hex("g" + text.substr(1)));
}

TEST_CASE("a secret is handed on in a file without a name, and taken once") {
  const Secret secret = make_secret();
  const int file = make_secret_file(secret);
  CHECK(take_secret(file) == secret);
  CHECK_FALSE(take_secret(file));
}

TEST_CASE("a descriptor that holds something else holds no secret") {
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  CHECK_FALSE(take_secret(nothing));
  int ends[2];
  REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
  CHECK_FALSE(take_secret(ends[0]));
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace graycube

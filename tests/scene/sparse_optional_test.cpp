#include "scene/sparse_optional.hpp"

#include <string>
#include <utility>

#include "catch.hpp"

using namespace graycube;

TEST_CASE("an absent sparse value takes a pointer's room and is equal to none") {
  const SparseOptional<std::string> none;
  CHECK(sizeof(none) == sizeof(void*));
  CHECK_FALSE(none);
  CHECK_FALSE(none.has_value());
  CHECK(none == std::nullopt);
  CHECK(none == SparseOptional<std::string>(std::optional<std::string>()));
  CHECK(none.value_or("three") == "three");
  CHECK_THROWS_AS(none.value(), std::bad_optional_access);
}

TEST_CASE("a sparse value is copied and compared by value") {
  SparseOptional<std::string> a = std::string("one");
  SparseOptional<std::string> b = a;
  CHECK(a == b);
  b = std::string("two");
  CHECK(*a == "one");
  CHECK(b.value() == "two");
  CHECK(b.value_or("three") == "two");
  CHECK_FALSE(a == b);
  a = std::move(b);
  CHECK(a->size() == 3);
  CHECK(*a == "two");
  b = std::nullopt;
  CHECK_FALSE(b);
  CHECK_FALSE(a == b);
  CHECK_FALSE(b == a);
  a = *&a;
  CHECK(*a == "two");
}

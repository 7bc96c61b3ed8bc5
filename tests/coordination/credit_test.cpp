#include "coordination/credit.hpp"

#include <random>
#include <vector>

#include "catch.hpp"

namespace graycube {
namespace {

constexpr std::uint64_t kOnes = ~std::uint64_t{0};

Credit power(int exponent) {
  Credit credit;
  credit.add_power(exponent);
  return credit;
}

TEST_CASE("two halves of a power make the next larger one, for every exponent") {
  for (int e = 1; e <= Credit::kMaxExponent; ++e) {
    Credit sum = power(e);
    CHECK_FALSE(sum.is_zero());
    CHECK(sum != power(e - 1));
    sum.add_power(e);
    CAPTURE(e);
    CHECK(sum == power(e - 1));
  }
  CHECK(power(0).is_exactly(1));
}

TEST_CASE("the powers from the largest to the smallest miss 1 by exactly the smallest") {
  Credit sum;
  for (int e = 1; e <= Credit::kMaxExponent; ++e) {
    sum.add_power(e);
    CHECK_FALSE(sum.is_exactly(1));
  }
  sum.add_power(Credit::kMaxExponent);
  CHECK(sum.is_exactly(1));
}

TEST_CASE("a carry runs through all words") {
  Credit sum = Credit::from_words({6, kOnes, kOnes, kOnes, kOnes - 1});
  sum.add_power(Credit::kMaxExponent);
  CHECK(sum.is_exactly(7));
  Credit words = Credit::from_words({0, kOnes, kOnes, kOnes, kOnes});
  words.add(words);
  CHECK(words == Credit::from_words({1, kOnes, kOnes, kOnes, kOnes - 1}));
}

TEST_CASE("sums do not depend on their order") {
  std::mt19937 engine(11);
  std::vector<Credit> parts(50);
  for (Credit& part : parts) {
    part =
        Credit::from_words({engine() % 8, engine(), kOnes - engine(), engine(), kOnes - engine()});
  }
  Credit forwards, backwards, halves, other_half;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    forwards.add(parts[i]);
    backwards.add(parts[parts.size() - 1 - i]);
    (i % 2 == 0 ? halves : other_half).add(parts[i]);
  }
  halves.add(other_half);
  CHECK(forwards == backwards);
  CHECK(forwards == halves);
}

/// Gives back the credit 2^-exponent of a ray, piece by piece, as an evaluator and its descendants
/// would: a quarter to each secondary ray, a quarter in equal powers to the shadow rays, the rest
/// at once.
void give_back(int exponent, int depth, std::mt19937& engine, Credit& sum) {
  if (depth == 0 || exponent + 10 > Credit::kMaxExponent || engine() % 4 == 0) {
    sum.add_power(exponent);
    return;
  }
  int quarters = 4;
  const auto secondary = static_cast<std::uint32_t>(engine() % 3);
  for (std::uint32_t i = 0; i < secondary; ++i, --quarters) {
    give_back(exponent + 2, depth - 1, engine, sum);
  }
  const auto shadow_rays = static_cast<std::uint32_t>(engine() % 65);
  if (shadow_rays > 0) {
    int k = 0;
    while ((1u << k) < shadow_rays) ++k;
    for (std::uint32_t i = 0; i < 1u << k; ++i) sum.add_power(exponent + 2 + k);
    --quarters;
  }
  for (int i = 0; i < quarters; ++i) sum.add_power(exponent + 2);
}

TEST_CASE("however a primary ray's credit is split, it comes back as exactly 1") {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    std::mt19937 engine(seed);
    Credit sum;
    give_back(0, 9, engine, sum);
    CAPTURE(seed);
    CHECK(sum.is_exactly(1));
  }
}

TEST_CASE("the deepest tree that fits one byte of exponent comes back whole") {
  Credit sum;
  // A chain of 120 reflections, each hit giving three quarters back, then 64 shadow rays and the
  // rest.
  int exponent = 0;
  for (int depth = 0; depth < 120; ++depth, exponent += 2) {
    for (int i = 0; i < 3; ++i) sum.add_power(exponent + 2);
  }
  for (int i = 0; i < 64; ++i) sum.add_power(exponent + 2 + 6);
  for (int i = 0; i < 3; ++i) sum.add_power(exponent + 2);
  CHECK(exponent + 8 <= Credit::kMaxExponent);
  CHECK(sum.is_exactly(1));
}

}  // namespace
}  // namespace graycube

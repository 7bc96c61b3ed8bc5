// Parts of slices on the wire.
#include <algorithm>
#include <vector>

#include "catch.hpp"
#include "proto/batch.hpp"

using namespace graycube;

namespace {

constexpr BatchLimits kLimits{.nodes = 8};
constexpr BatchStamp kStamp{.job = 3, .epoch = 0, .sender = 5, .incarnation = 77, .sequence = 2};
const std::vector<std::byte> kBytes(1000, std::byte{7});

std::vector<std::byte> batch_of(const SlicePart& part) { return encode_slice_part(kStamp, part); }

bool is_refused(const SlicePart& part) {
  SlicePart untouched{1, 2, 3, {}};
  const auto result = decode_slice_part(batch_of(part), kLimits, untouched);
  CHECK(untouched.rank == 1);
  return result == BatchResult(BatchError::kBadValue);
}

}  // namespace

TEST_CASE("a part of a slice says whose it is, where it begins, and how long the slice is") {
  const auto batch = batch_of({6, 4000, 5000, kBytes});
  CHECK(batch.size() == kBatchHeaderBytes + 20 + kBytes.size());
  SlicePart part;
  REQUIRE(std::holds_alternative<BatchHeader>(decode_slice_part(batch, kLimits, part)));
  CHECK(part.rank == 6);
  CHECK(part.offset == 4000);
  CHECK(part.total == 5000);
  CHECK(std::ranges::equal(part.bytes, kBytes));
  CHECK(batch_of({6, 0, kMaxSlicePartBytes, std::vector<std::byte>(kMaxSlicePartBytes)}).size() ==
        kMaxBatchBytes);
}

TEST_CASE("a part of a slice that lies beyond it, of too large a slice or of nobody's is refused") {
  CHECK(is_refused({8, 0, 1000, kBytes}));
  CHECK(is_refused({6, 0, 999, kBytes}));
  CHECK(is_refused({6, 1, 1000, kBytes}));
  CHECK(is_refused({6, 0xFFFF'FFFF'FFFF'FFFF, 1000, kBytes}));
  CHECK(is_refused({6, 0, kMaxSliceBytes + 1, kBytes}));
  CHECK_FALSE(is_refused({1, 0, kMaxSliceBytes, kBytes}));
}

TEST_CASE("a part of a slice without bytes is no batch") {
  auto batch = batch_of({6, 0, 1000, {kBytes.data(), 1}});
  batch.pop_back();
  // Count of the slice's bytes, and payload bytes.
  batch[32] = std::byte{0};
  batch[36] = std::byte{20};
  CHECK(peek_header(batch) == BatchResult(BatchError::kBadLength));
}

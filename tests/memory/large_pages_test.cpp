#include "memory/large_pages.hpp"

#include <sys/resource.h>

#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "memory/kept_heap.hpp"

namespace graycube {
namespace {

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

long faults_of_writing(ZeroPages::Use use, std::size_t bytes) {
  const ZeroPages pages(bytes, use);
  const long before = page_faults();
  std::memset(pages.data(), 1, bytes);
  return page_faults() - before;
}

/// Whether the system gives large pages to a process that asks, here and now.
bool has_large_pages() {
  return faults_of_writing(ZeroPages::Use::kAllOver, 8 * kLargePage) < 4 * 512;
}

}  // namespace

TEST_CASE("zero pages are zero, and whose they become has what was written") {
  for (const auto use : {ZeroPages::Use::kAllOver, ZeroPages::Use::kHereAndThere}) {
    constexpr std::size_t kCount = 3 * kLargePage / sizeof(std::uint64_t) + 7;
    ZeroedArray<std::uint64_t> array(kCount, use);
    for (std::size_t i = 0; i < kCount; i += 511) REQUIRE(array[i] == 0);
    REQUIRE(array[kCount - 1] == 0);
    array[0] = 1;
    array[kCount - 1] = 2;
    ZeroedArray<std::uint64_t> other = std::move(array);
    REQUIRE(other[0] == 1);
    REQUIRE(other[kCount - 1] == 2);
    array = ZeroedArray<std::uint64_t>(1, use);
    REQUIRE(array[0] == 0);
  }
  REQUIRE(ZeroPages(0, ZeroPages::Use::kAllOver).data() == nullptr);
}

TEST_CASE("only memory to be written all over lies in large pages") {
  // With large pages, each touch would take 2 MiB.
  REQUIRE(faults_of_writing(ZeroPages::Use::kHereAndThere, 8 * kLargePage) >= 8 * 512);
  if (!has_large_pages()) WARN("this system has no large pages now");
}

TEST_CASE("a kept heap serves all threads, and again what was freed") {
  keep_freed_memory(1, 16 * kLargePage);
  const auto fill = [] {
    std::vector<std::vector<char>> blocks;
    for (std::size_t size = 1; size < 6 * kLargePage; size = size * 3 + 1)
      blocks.emplace_back(size, 'x');
    for (const auto& block : blocks) {
      for (const char c : block) REQUIRE(c == 'x');
    }
  };
  const bool has_large = has_large_pages();
  const long at_first = page_faults();
  {
    // The very first block lies in a large page, too.
    std::vector<std::vector<char>> blocks;
    for (int i = 0; i < 16; ++i) blocks.emplace_back(kLargePage / 32, 'v');
  }
  if (kIsOurHeap && has_large) REQUIRE(page_faults() - at_first < 64);
  // Memory that was touched ahead is there when it is needed.
  touch_heap_ahead(2 * kLargePage);
  const auto end_of_block = [] {
    const long faults = page_faults();
    void* const block = std::malloc(2 * kLargePage);
    static_cast<volatile char*>(block)[2 * kLargePage - 1] = 1;
    std::free(block);
    return page_faults() - faults;
  };
  if (kIsOurHeap) REQUIRE(end_of_block() == 0);
  fill();
  const long before = page_faults();
  fill();
  if (kIsOurHeap) REQUIRE(page_faults() - before < 64);
  std::thread(fill).join();
  // More memory than was set aside, and a block that is larger than any heap.
  std::vector<std::vector<char>> many;
  for (int i = 0; i < 24; ++i) many.emplace_back(2 * kLargePage, 'y');
  REQUIRE(std::vector<char>(64 * kLargePage, 'z').back() == 'z');
  for (const auto& block : many) REQUIRE((block.front() == 'y' && block.back() == 'y'));
}

}  // namespace graycube

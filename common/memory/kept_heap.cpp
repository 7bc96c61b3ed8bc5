#include "memory/kept_heap.hpp"

#include <malloc.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

#include "memory/large_pages.hpp"

namespace graycube {
namespace {

#ifdef __GLIBC__
constexpr int kMapped = 32 << 20, kKept = 256 << 20, kAtOnce = 1 << 20;

/// Grows the heap once by all that is to lie in large pages. These begin beyond the end of the
/// block that made it grow, behind all that malloc has written to: a range in which a page of 4 KiB
/// is in use can't become a large page. The memory before them is left out.
void set_large_pages_aside(std::size_t bytes) {
  mallopt(M_TOP_PAD, static_cast<int>(bytes + 2 * kLargePage));
  void* const block = std::malloc(kAtOnce);
  if (block == nullptr) return;
  const auto place = reinterpret_cast<std::uintptr_t>(block);
  std::free(block);
  const std::uintptr_t begin = ((place + kAtOnce) / kLargePage + 1) * kLargePage;
  const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0));
  if (begin >= end || end - place > bytes + 4 * kLargePage) return;
  // This block is never given back, and only its sizes, before and behind it, are ever touched.
  // Volatile, so that the compiler doesn't drop it as unused.
  [[maybe_unused]] static void* volatile left_out = nullptr;
  left_out = std::malloc(begin - place - 2 * sizeof(std::size_t));
  ask_for_large_pages(reinterpret_cast<void*>(begin), end - begin);
}
#endif

}  // namespace

void keep_freed_memory(unsigned arenas, std::size_t large) {
#ifdef __GLIBC__
  mallopt(M_ARENA_MAX, static_cast<int>(arenas));
  mallopt(M_MMAP_THRESHOLD, kMapped);
  mallopt(M_TRIM_THRESHOLD, kKept);
  if (kIsOurHeap && large > 0) set_large_pages_aside(large);
  mallopt(M_TOP_PAD, kAtOnce);
#else
  static_cast<void>(arenas), static_cast<void>(large);
#endif
}

void touch_heap_ahead(std::size_t bytes) {
  void* const block = std::malloc(bytes);
  if (block != nullptr && bytes > 0) static_cast<volatile char*>(block)[bytes - 1] = 0;
  std::free(block);
}

}  // namespace graycube

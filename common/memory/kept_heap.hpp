// Makes a process of the farm keep the memory that it has freed.
#pragma once

#include <cstddef>

namespace graycube {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
/// Sanitizers have heaps of their own.
inline constexpr bool kIsOurHeap = false;
#else
inline constexpr bool kIsOurHeap = true;
#endif

/// Freed memory is kept for later use, for batches above all, instead of being given back to the
/// system and touched anew. There are at most `arenas` heaps; `large` bytes of address space are
/// set aside for the first, in large pages (large_pages.hpp) that are taken as they are needed. To
/// be called before there are threads; does nothing if the C library isn't glibc.
void keep_freed_memory(unsigned arenas, std::size_t large);

/// Makes the system provide the large page in which the next `bytes` of the calling thread's heap
/// end now, if it hasn't yet: that may take as long as a tile.
void touch_heap_ahead(std::size_t bytes);

}  // namespace graycube

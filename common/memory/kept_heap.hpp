// How a process of the farm keeps memory.
#pragma once

#include <cstddef>

namespace graycube {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
/// Sanitizers have heaps of their own.
inline constexpr bool kIsOurHeap = false;
#else
inline constexpr bool kIsOurHeap = true;
#endif

/// Freed memory is kept for what comes next, batches above all, instead of being given back to the
/// system and touched anew. At most `arenas` heaps; the first of them, which `large` bytes of
/// address space are set aside for, lies in large pages (large_pages.hpp): they are taken as they
/// are needed. To be called before there are threads; does nothing where the C library isn't glibc.
void keep_freed_memory(unsigned arenas, std::size_t large);

/// Has the system provide now the large page that the next `bytes` of the calling thread's heap end
/// in, if it doesn't yet: it may take as long as a tile.
void touch_heap_ahead(std::size_t bytes);

}  // namespace graycube

// How a process of the farm keeps memory.
#pragma once

#include <malloc.h>

namespace graycube {

/// Freed memory is kept for what comes next, batches above all, instead of being given back to the system and
/// touched anew: page by page that costs more than what is done with it. At most `arenas` heaps. To be called
/// before there are threads; does nothing where the C library isn't glibc.
inline void keep_freed_memory(unsigned arenas) {
#ifdef __GLIBC__
  constexpr int kMapped = 32 << 20, kKept = 256 << 20, kAtOnce = 1 << 20;
  mallopt(M_ARENA_MAX, static_cast<int>(arenas));
  mallopt(M_MMAP_THRESHOLD, kMapped);
  mallopt(M_TRIM_THRESHOLD, kKept);
  mallopt(M_TOP_PAD, kAtOnce);
#else
  static_cast<void>(arenas);
#endif
}

}  // namespace graycube

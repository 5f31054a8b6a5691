// SPDX-License-Identifier: Apache-2.0
//
// What the C library keeps of memory that was freed.
#pragma once

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace nef {

/// Gives the system back what was freed in many small parts, as the coordinates of a large mesh are; glibc keeps these
/// pages otherwise, and large arrays that come later do not fit in. Costs a walk through what is free, some
/// milliseconds for a gigabyte; nothing happens with another C library. Any thread may call it.
inline void return_freed_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

/// For a program, at its beginning: keeps up to 1 GiB of what is freed at the end of the heap, and takes arrays of less
/// than 32 MiB from the heap, so that an operation finds what the one before it used, instead of having the system
/// clear each page anew, which is a tenth of the time of an operation. For the whole process, so libraries do not call
/// it; nothing happens with another C library.
inline void keep_freed_memory() {
#if defined(__GLIBC__)
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
}

}  // namespace nef

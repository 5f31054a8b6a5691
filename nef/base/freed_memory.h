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

}  // namespace nef

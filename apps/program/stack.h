// SPDX-License-Identifier: Apache-2.0
//
// The size of the stack, which limits of the system may make too small for nested expressions and scenes.
#pragma once

namespace nef {

/// Raises a small limit on the stack of this thread, and on those of threads that are started later, to 8 MB as far as
/// the system allows. Throws Error if less than 4 MB are left: programs would end in a segmentation fault.
void require_stack();

}  // namespace nef

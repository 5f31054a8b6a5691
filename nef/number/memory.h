// SPDX-License-Identifier: Apache-2.0
//
// What happens when GMP gets no memory.
#pragma once

namespace nef {

/// Makes GMP throw std::bad_alloc where it gets no memory; otherwise it writes "Cannot allocate memory" and aborts. GMP
/// has one set of memory functions for the whole process, so the library never sets them by itself: a program that
/// wants this calls it once, before other threads use GMP. What GMP's own functions have allocated stays valid; memory
/// of functions that somebody else has set does not, so do not mix the two.
void let_gmp_throw_bad_alloc();

}  // namespace nef

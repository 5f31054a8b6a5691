// SPDX-License-Identifier: Apache-2.0
//
// Like GMP's own functions these use malloc, realloc and free, so that blocks may come from either. Exceptions pass
// through GMP's C code by its unwind tables, which the ABIs of all common 64-bit systems demand; a number whose
// reallocation fails keeps its old value.
#include "nef/number/memory.h"

#include <gmp.h>

#include <cstdlib>
#include <new>

namespace nef {
namespace {

void* checked(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void* allocate(std::size_t size) { return checked(std::malloc(size)); }
void* reallocate(void* block, std::size_t, std::size_t size) { return checked(std::realloc(block, size)); }
void release(void* block, std::size_t) { std::free(block); }

}  // namespace

void let_gmp_throw_bad_alloc() { mp_set_memory_functions(allocate, reallocate, release); }

}  // namespace nef

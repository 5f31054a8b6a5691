// SPDX-License-Identifier: Apache-2.0
//
// Lack of memory inside GMP.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <new>

#include "nef/number/memory.h"
#include "nef/number/number.h"

#ifndef NEF_SANITIZED

namespace {

// Bounds the address space of the process as long as it lives.
class AddressSpace {
 public:
  explicit AddressSpace(rlim_t bytes) {
    getrlimit(RLIMIT_AS, &before_);
    rlimit less = before_;
    less.rlim_cur = bytes;
    setrlimit(RLIMIT_AS, &less);
  }
  ~AddressSpace() { setrlimit(RLIMIT_AS, &before_); }
  AddressSpace(const AddressSpace&) = delete;
  AddressSpace& operator=(const AddressSpace&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("GMP throws where it gets no memory, and the number keeps its value") {
  nef::Integer x = 17;  // made with GMP's own functions
  nef::let_gmp_throw_bad_alloc();
  {
    const AddressSpace limit(rlim_t{2} << 30U);
    CHECK_THROWS_AS(mpz_setbit(x.get_mpz_t(), 1UL << 36U), std::bad_alloc);
    CHECK_THROWS_AS(nef::Integer(nef::Integer(1) << (1UL << 36U)), std::bad_alloc);
  }
  CHECK(x == 17);
  mpz_setbit(x.get_mpz_t(), 1000);
  CHECK(mpz_sizeinbase(x.get_mpz_t(), 2) == 1001);
}

#endif

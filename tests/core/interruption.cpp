// SPDX-License-Identifier: Apache-2.0
//
// Computations that are stopped from outside end by an exception; without one they are what they always are.
#include "nef/base/interruption.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "nef/base/parallel.h"
#include "tests/support/literals.h"

namespace nef {

TEST_CASE("what is stopped throws, and the operands are whole") {
  const Polyhedron a = test::set("box(0,0,0,2,2,2)");
  const Polyhedron b = test::set("box(1,1,1,3,3,3)");
  const std::atomic<bool> stop{true};
  {
    const Interruptible interruptible(&stop);
    CHECK_THROWS_AS(unite(a, b), Interrupted);
    CHECK_THROWS_AS(interior(a), Interrupted);
    CHECK_THROWS_AS(convex_hull(std::vector<Rational3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), Interrupted);
    {
      const Interruptible never(nullptr);
      CHECK_FALSE(unite(a, b).is_empty());
    }
    CHECK_THROWS_AS(unite(a, b), Interrupted);
  }
  CHECK(validate(a.complex()).empty());
  CHECK(volume(unite(a, b)) == Rational(15));
}

TEST_CASE("threads are stopped with the one that they work for") {
  for (const unsigned threads : {1U, 2U, 0U}) {
    std::atomic<bool> stop{false};
    std::atomic<int> begun{0};
    const Interruptible interruptible(&stop);
    CHECK_THROWS_AS(parallel_for(100000, threads,
                                 [&](std::size_t) {
                                   if (++begun == 10) stop = true;
                                   check_interruption();
                                 }),
                    Interrupted);
    CHECK(begun < 100000);
    stop = false;
    CHECK_NOTHROW(parallel_for(100, threads, [](std::size_t) { check_interruption(); }));
  }
  // Another thread is none of that.
  const std::atomic<bool> stop{true};
  const Interruptible interruptible(&stop);
  bool thrown = false;
  std::thread other([&thrown] {
    try {
      check_interruption();
    } catch (const Interrupted&) {
      thrown = true;
    }
  });
  other.join();
  CHECK_FALSE(thrown);
}

}  // namespace nef

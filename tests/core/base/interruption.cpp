// SPDX-License-Identifier: Apache-2.0
//
// Computations that are stopped from outside end by an exception; without one they are what they always are.
#include "nef/base/interruption.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <functional>
#include <thread>
#include <vector>

#include "nef/base/threads/parallel.h"
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

TEST_CASE("threads are stopped with the one that they work for", "[threads]") {
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

TEST_CASE("a function that is asked stops what goes on inside one operation", "[threads]") {
  // Some 200 vertices meet: many more questions than there are steps of the operation.
  std::vector<Polyhedron> columns;
  std::vector<Polyhedron> rows;
  for (int i = 0; i < 6; ++i) {
    columns.push_back(make_box({3 * i, -1, 0}, {3 * i + 1, 20, 1}));
    rows.push_back(make_box({-1, 3 * i, 0}, {20, 3 * i + 1, 1}));
  }
  const Polyhedron a = unite_all(columns);
  const Polyhedron b = unite_all(rows);
  int questions = 0;
  bool others_asked = false;
  const std::thread::id here = std::this_thread::get_id();
  const std::function<bool()> ask = [&] {
    if (std::this_thread::get_id() != here) others_asked = true;
    return ++questions > 10;
  };
  {
    const Interruptible interruptible(ask);
    CHECK_THROWS_AS(unite(a, b), Interrupted);
    CHECK_THROWS_AS(unite(a, b), Interrupted);
  }
  CHECK(questions == 11);
  CHECK(volume(unite(a, b)) == Rational(6 * 21 * 2 - 36));
  for (const unsigned threads : {1U, 2U, 0U}) {
    questions = 0;
    const Interruptible interruptible(ask);
    const std::atomic<bool> never{false};
    const auto body = [](std::size_t) { check_interruption(); };
    CHECK_THROWS_AS(parallel_for(100000, threads, body), Interrupted);
    CHECK_NOTHROW([&] {
      const Interruptible other(&never);
      parallel_for(1000, threads, body);
    }());
  }
  CHECK_FALSE(others_asked);
  // What stops the thread anyway goes on doing so under a function that has no objection, and under none.
  std::atomic<bool> stop{false};
  const std::function<bool()> agree = [] { return false; };
  const std::function<bool()> nothing;
  const Interruptible outer(&stop);
  const Interruptible inner(agree);
  const Interruptible innermost(nothing);
  CHECK_NOTHROW(unite(a, b));
  stop = true;
  CHECK_THROWS_AS(unite(a, b), Interrupted);
}

}  // namespace nef

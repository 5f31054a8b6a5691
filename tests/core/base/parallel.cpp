// SPDX-License-Identifier: Apache-2.0
//
// Several threads give what one gives.
#include "nef/base/threads/parallel.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "nef/base/timing/phase_timer.h"
#include "nef/base/timing/predicate_counts.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

TEST_CASE("parallel_for calls every index once and books all predicate counts on the caller", "[parallel]") {
  for (const unsigned threads : {0U, 1U, 2U, 7U}) {
    std::vector<std::atomic<int>> calls(100);
    PredicateCounts counts;
    counts.filter = 7;
    const auto body = [&](std::size_t i, const Monitor& own) {
      ++calls[i];
      own.count_filter(i);
      own.count_exact();
      parallel_for(2, own.on_threads(threads), [](std::size_t, const Monitor& inner) { inner.count_filter(1000); });
      own.count_identity();
    };
    parallel_for(calls.size(), Monitor().on_threads(threads).counting(counts), body);
    for (const auto& count : calls) CHECK(count == 1);
    CHECK(counts.filter == 7 + 99 * 50 + 200 * 1000);
    CHECK(counts.exact == 100);
    CHECK(counts.identity == 100);
  }
}

TEST_CASE("An operation counts the same predicates on any number of threads", "[parallel][fast]") {
  std::vector<Polyhedron> boxes;
  for (int i = 0; i < 30; ++i) boxes.push_back(make_box({i % 7, i % 5, i / 7}, {i % 7 + 2, i % 5 + 1, i / 7 + 2}));
  const auto counted = [&boxes](unsigned threads) {
    PredicateCounts counts;
    unite_all(boxes, Monitor().on_threads(threads).counting(counts));
    return counts;
  };
  const PredicateCounts one = counted(1);
  CHECK(one.identity > 0);
  CHECK(one.filter > 0);
  for (const unsigned threads : {2U, 0U}) {
    const PredicateCounts many = counted(threads);
    CHECK(many.identity == one.identity);
    CHECK(many.filter == one.filter);
    CHECK(many.exact == one.exact);
  }
}

TEST_CASE("A phase books what it counts on itself and on whoever counts outside", "[parallel]") {
  PredicateCounts outer;
  PredicateCounts sum;
  double seconds = 0;
  {
    const PhaseTimer phase(seconds, sum, Monitor().counting(outer));
    phase.monitor().count_filter(3);
    CHECK(sum.filter == 0);
  }
  CHECK(sum.filter == 3);
  CHECK(outer.filter == 3);
}

TEST_CASE("An exception of a worker arrives in the caller", "[parallel]") {
  const auto body = [](std::size_t i, const Monitor&) {
    if (i == 5) throw std::runtime_error("five");
  };
  CHECK_THROWS_WITH(parallel_for(20, Monitor().on_threads(3), body), "five");
  // What has been counted before is still there.
  PredicateCounts counts;
  counts.filter = 1000;
  const auto count_and_throw = [](std::size_t, const Monitor& own) {
    own.count_filter();
    throw std::runtime_error("at once");
  };
  CHECK_THROWS_WITH(parallel_for(20, Monitor().on_threads(3).counting(counts), count_and_throw), "at once");
  CHECK(counts.filter > 1000);
  CHECK(counts.filter <= 1020);
}

TEST_CASE("Of several exceptions the first in the order of the calls arrives, however fast the others are",
          "[parallel]") {
  for (const unsigned threads : {0U, 1U, 2U, 7U}) {
    CHECK_THROWS_WITH(parallel_for(64, Monitor().on_threads(threads),
                                   [](std::size_t i, const Monitor&) {
                                     if (i == 3) std::this_thread::sleep_for(std::chrono::milliseconds(20));
                                     if (i >= 3) throw std::runtime_error("call " + std::to_string(i));
                                   }),
                      "call 3");
  }
}

TEST_CASE("Unions and intersections of many sets do not depend on the number of threads", "[parallel]") {
  std::vector<Polyhedron> boxes;
  for (int i = 0; i < 40; ++i) {
    // Neighbours overlap, share faces, or touch in an edge.
    boxes.push_back(make_box({i % 7, i % 5, i / 7}, {i % 7 + 1 + i % 2, i % 5 + 1, i / 7 + 2}));
  }
  const Polyhedron one = unite_all(boxes);
  CHECK(equal(unite_all(boxes, Monitor().on_threads(3)), one));
  CHECK(equal(unite_all(boxes, Monitor().on_threads(0)), one));

  std::vector<Polyhedron> slabs;
  for (const Polyhedron& box : boxes) slabs.push_back(complement(box));
  CHECK(equal(intersect_all(slabs, Monitor().on_threads(3)), complement(one)));
}

}  // namespace
}  // namespace nef

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

#include "nef/base/timing/predicate_counts.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

TEST_CASE("parallel_for calls every index once and books all predicate counts on the caller", "[parallel]") {
  for (const unsigned threads : {0U, 1U, 2U, 7U}) {
    std::vector<std::atomic<int>> calls(100);
    const std::uint64_t before = predicate_counts().exact;
    parallel_for(calls.size(), threads, [&](std::size_t i) {
      ++calls[i];
      predicate_counts().exact += i;
      parallel_for(2, threads, [](std::size_t) { predicate_counts().exact += 1000; });
    });
    for (const auto& count : calls) CHECK(count == 1);
    CHECK(predicate_counts().exact - before == 99 * 50 + 200 * 1000);
  }
}

TEST_CASE("An exception of a worker arrives in the caller", "[parallel]") {
  const auto body = [](std::size_t i) {
    if (i == 5) throw std::runtime_error("five");
  };
  CHECK_THROWS_WITH(parallel_for(20, 3, body), "five");
  // What the caller's thread has counted before is still there.
  predicate_counts().filter += 1000;
  const std::uint64_t before = predicate_counts().filter;
  CHECK_THROWS_WITH(parallel_for(20, 3,
                                 [](std::size_t) {
                                   ++predicate_counts().filter;
                                   throw std::runtime_error("at once");
                                 }),
                    "at once");
  CHECK(predicate_counts().filter > before);
  CHECK(predicate_counts().filter <= before + 20);
}

TEST_CASE("Of several exceptions the first in the order of the calls arrives, however fast the others are",
          "[parallel]") {
  for (const unsigned threads : {0U, 1U, 2U, 7U}) {
    CHECK_THROWS_WITH(parallel_for(64, threads,
                                   [](std::size_t i) {
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
  const Polyhedron one = unite_all(boxes, 1);
  CHECK(equal(unite_all(boxes, 3), one));
  CHECK(equal(unite_all(boxes, 0), one));

  std::vector<Polyhedron> slabs;
  for (const Polyhedron& box : boxes) slabs.push_back(complement(box));
  CHECK(equal(intersect_all(slabs, 3), complement(one)));
}

}  // namespace
}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
//
// Work in another process ends within its bounds, and what it found or refused comes back.
#include "nef/io/bounded_process.h"

#include <atomic>
#include <catch2/catch.hpp>

#include "nef/base/error.h"

namespace nef::test {

TEST_CASE("work in a process of its own: results, errors and bounds") {
  std::string text(300000, 'x');
  CHECK(run_bounded(std::size_t{1} << 28U, 5, [&] { return text; }) == text);
  CHECK_THROWS_AS(run_bounded(std::size_t{1} << 28U, 5, []() -> std::string { throw InputError("no"); }), InputError);
  CHECK_FALSE(run_bounded(std::size_t{1} << 26U, 5, [] {
    std::string grows = "x";
    while (true) grows += grows;
    return grows;
  }));
  CHECK_FALSE(run_bounded(std::size_t{1} << 28U, 1, []() -> std::string {
    for (std::atomic<unsigned> turns = 0;;) ++turns;
  }));
}

}  // namespace nef::test

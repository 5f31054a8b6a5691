// SPDX-License-Identifier: Apache-2.0
//
// Work in another process ends within its bounds, and what it found or refused comes back.
#include "nef/io/bounded_process.h"

#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>

#include "nef/base/error.h"

namespace nef::test {

TEST_CASE("limits grow with the file") {
  CHECK(limits_text(parser_limits(0)) == "512 MB and 20 s");
  CHECK(limits_text(parser_limits(std::size_t{1} << 20U)) == "768 MB and 24 s");
}

TEST_CASE("work in a process of its own: results, errors and bounds") {
  std::string text(300000, 'x');
  CHECK(run_bounded({.bytes = std::size_t{1} << 28U, .seconds = 5}, [&] { return text; }) == text);
  CHECK_THROWS_AS(
      run_bounded({.bytes = std::size_t{1} << 28U, .seconds = 5}, []() -> std::string { throw InputError("no"); }),
      InputError);
  CHECK_FALSE(run_bounded({.bytes = std::size_t{1} << 26U, .seconds = 5}, [] {
    std::string grows = "x";
    while (true) grows += grows;
    return grows;
  }));
  CHECK_FALSE(run_bounded({.bytes = std::size_t{1} << 28U, .seconds = 1}, []() -> std::string {
    for (std::atomic<unsigned> turns = 0;;) ++turns;
  }));
  // What waits takes no processor time.
  CHECK_FALSE(run_bounded({.bytes = std::size_t{1} << 28U, .seconds = 1}, []() -> std::string {
    for (;;) pause();
  }));
}

}  // namespace nef::test

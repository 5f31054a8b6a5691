// SPDX-License-Identifier: Apache-2.0
//
// Long computations tell how far they have come; nothing else changes.
#include "nef/base/progress.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/polyhedron.h"
#include "tests/support/literals.h"

namespace nef {
namespace {

// What was told, in order, with what must hold of all of it checked at once.
struct Told {
  std::map<std::string, std::size_t> calls;
  std::size_t last = 0;
  std::string phase;
  bool in_order = true;
  bool in_this_thread = true;
  std::thread::id here = std::this_thread::get_id();

  ProgressFunction function() {
    return [this](const char* now, std::size_t done, std::size_t total) {
      ++calls[now];
      in_this_thread = in_this_thread && std::this_thread::get_id() == here;
      in_order = in_order && done <= total && (now != phase || done >= last || done == 0);
      phase = now;
      last = done;
    };
  }
};

}  // namespace

TEST_CASE("a Boolean tells its phases, and only while somebody listens") {
  const Polyhedron a = test::set("box(0,0,0,2,2,2)");
  const Polyhedron b = test::set("box(1,1,1,3,3,3)");
  Told told;
  const ProgressFunction function = told.function();
  const Monitor monitor = Monitor().telling(function);
  CHECK(volume(unite(a, b, monitor)) == Rational(15));
  CHECK(told.calls.at("edges through facets") == 3);  // at the beginning, and once for each operand
  CHECK(told.calls.at("sphere maps") == 1);
  CHECK(told.calls.at("synthesis") == 4);
  CHECK(told.last == 3);
  const auto before = told.calls;
  unite(a, b, monitor.quiet());
  const ProgressFunction nobody;
  unite(a, b, monitor.telling(nobody));
  unite(a, b);
  CHECK(told.calls == before);
  CHECK(told.in_order);
}

TEST_CASE("many sets are counted as they are combined, by the thread that waits", "[threads]") {
  std::vector<Polyhedron> sets;
  for (int i = 0; i < 40; ++i) sets.push_back(make_box({2 * i, 0, 0}, {2 * i + 1, 1, 1}));
  for (const unsigned threads : {1U, 2U, 0U}) {
    Told told;
    const ProgressFunction function = told.function();
    CHECK(volume(unite_all(sets, Monitor().on_threads(threads).telling(function))) == Rational(40));
    CHECK(told.calls.size() == 1);
    CHECK(told.calls.count("sets") == 1);
    CHECK(told.in_this_thread);
    if (threads == 1) {
      CHECK(told.in_order);
      CHECK(told.last == 39);
      CHECK(told.calls.at("sets") == 39);
    }
  }
}

TEST_CASE("what a listener throws ends the computation and leaves the operands whole", "[threads]") {
  const Polyhedron a = test::set("box(0,0,0,2,2,2)");
  const Polyhedron b = test::set("box(1,1,1,3,3,3)");
  for (const unsigned threads : {1U, 2U}) {
    const ProgressFunction refuse = [](const char*, std::size_t, std::size_t) { throw std::runtime_error("enough"); };
    const Monitor monitor = Monitor().on_threads(threads).telling(refuse);
    CHECK_THROWS_WITH(unite(a, b, monitor), "enough");
    CHECK_THROWS_WITH(interior(a, monitor), "enough");
    CHECK_THROWS_WITH(unite_all(std::vector<Polyhedron>{a, b}, monitor), "enough");
  }
  CHECK(volume(unite(a, b)) == Rational(15));
}

}  // namespace nef

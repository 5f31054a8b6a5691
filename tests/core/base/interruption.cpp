// SPDX-License-Identifier: Apache-2.0
//
// Computations that are stopped from outside end by an exception; without one they are what they always are.
#include "nef/base/interruption.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/time_limit.h"
#include "tests/support/literals.h"

namespace nef {

TEST_CASE("what is stopped throws, and the operands are whole") {
  const Polyhedron a = test::set("box(0,0,0,2,2,2)");
  const Polyhedron b = test::set("box(1,1,1,3,3,3)");
  const std::atomic<bool> stop{true};
  const Monitor monitor = Monitor().stopped_by(&stop);
  CHECK_THROWS_AS(unite(a, b, monitor), Interrupted);
  CHECK_THROWS_AS(interior(a, monitor), Interrupted);
  CHECK_THROWS_AS(convex_hull(std::vector<Rational3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, monitor),
                  Interrupted);
  CHECK_FALSE(unite(a, b, Monitor().stopped_by(nullptr)).is_empty());
  // Null changes nothing.
  CHECK_THROWS_AS(unite(a, b, monitor.stopped_by(nullptr)), Interrupted);
  CHECK(validate(a.complex()).empty());
  CHECK(volume(unite(a, b)) == Rational(15));
}

TEST_CASE("threads are stopped with the one that they work for", "[threads]") {
  for (const unsigned threads : {1U, 2U, 0U}) {
    std::atomic<bool> stop{false};
    std::atomic<int> begun{0};
    const Monitor monitor = Monitor().on_threads(threads).stopped_by(&stop);
    const auto stop_soon = [&](std::size_t, const Monitor& own) {
      if (++begun == 10) stop = true;
      own.check_interruption();
    };
    CHECK_THROWS_AS(parallel_for(100000, monitor, stop_soon), Interrupted);
    CHECK(begun < 100000);
    stop = false;
    CHECK_NOTHROW(parallel_for(100, monitor, [](std::size_t, const Monitor& own) { own.check_interruption(); }));
  }
}

TEST_CASE("the monitor of another thread neither asks nor tells, but is stopped with its own", "[threads]") {
  int questions = 0;
  int told = 0;
  bool stops = false;
  const StopQuestion question([&] {
    ++questions;
    return stops;
  });
  const ProgressFunction tell = [&told](const char*, std::size_t, std::size_t) { ++told; };
  const Monitor monitor = question.monitor().telling(tell);
  const Monitor other = monitor.of_other_thread();
  for (int i = 0; i < 100; ++i) {
    CHECK_NOTHROW(other.check_interruption());
    other.tell_progress("phase", 0, 1);
  }
  CHECK(questions == 0);
  CHECK(told == 0);
  stops = true;
  const auto ask = [](const Monitor& own) {
    for (int i = 0; i < 100; ++i) own.check_interruption();
  };
  CHECK_NOTHROW(ask(other));
  CHECK_THROWS_AS(ask(monitor), Interrupted);
  CHECK(questions == 1);
  CHECK_THROWS_AS(other.check_interruption(), Interrupted);
}

TEST_CASE("what is done on other threads of a loop asks and tells in the thread of its caller only", "[threads]") {
  const std::thread::id here = std::this_thread::get_id();
  for (const unsigned threads : {1U, 2U, 0U}) {
    std::atomic<bool> here_only{true};
    std::atomic<int> told{0};
    std::atomic<int> done_here{0};
    const auto note = [&] {
      if (std::this_thread::get_id() != here) here_only = false;
    };
    const StopQuestion question([&] {
      note();
      return false;
    });
    const ProgressFunction tell = [&](const char*, std::size_t, std::size_t) {
      note();
      ++told;
    };
    parallel_for(1000, question.monitor().on_threads(threads).telling(tell), [&](std::size_t, const Monitor& own) {
      if (std::this_thread::get_id() == here) ++done_here;
      own.check_interruption();
      own.tell_progress("phase", 0, 0);
    });
    CHECK(here_only);
    CHECK(told == done_here);
  }
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
    const StopQuestion question(ask);
    CHECK_THROWS_AS(unite(a, b, question.monitor()), Interrupted);
    CHECK_THROWS_AS(unite(a, b, question.monitor()), Interrupted);
  }
  CHECK(questions == 11);
  CHECK(volume(unite(a, b)) == Rational(6 * 21 * 2 - 36));
  for (const unsigned threads : {1U, 2U, 0U}) {
    questions = 0;
    const StopQuestion question(ask);
    const std::atomic<bool> never{false};
    const auto body = [](std::size_t, const Monitor& own) { own.check_interruption(); };
    CHECK_THROWS_AS(parallel_for(100000, question.monitor().on_threads(threads), body), Interrupted);
    CHECK_NOTHROW(parallel_for(1000, question.monitor().on_threads(threads).stopped_by(&never), body));
  }
  CHECK_FALSE(others_asked);
  // What stops the computation anyway goes on doing so under a function that has no objection, and under none.
  std::atomic<bool> stop{false};
  const StopQuestion inner([] { return false; }, Monitor().stopped_by(&stop));
  const StopQuestion innermost({}, inner.monitor());
  CHECK_NOTHROW(unite(a, b, innermost.monitor()));
  stop = true;
  CHECK_THROWS_AS(unite(a, b, innermost.monitor()), Interrupted);
  // Questions inside each other are all asked.
  bool outer_stops = false;
  const StopQuestion outer([&outer_stops] { return outer_stops; });
  const StopQuestion within([] { return false; }, outer.monitor());
  CHECK_NOTHROW(unite(a, b, within.monitor()));
  outer_stops = true;
  CHECK_THROWS_AS(unite(a, b, within.monitor()), Interrupted);
}

TEST_CASE("a time limit stops other threads while the one that began waits for them", "[threads]") {
  constexpr double kLong = 60;  // seconds that the loop goes on if nothing stops it
  const TimeLimit limit(0.01);
  const StopQuestion inner([] { return false; }, limit.monitor());
  for (const Monitor& monitor : {limit.monitor(), inner.monitor()}) {
    bool is_stopped = false;
    std::thread other([&is_stopped, own = monitor.of_other_thread()] {
      const Stopwatch watch;
      try {
        while (watch.seconds() < kLong) own.check_interruption();
      } catch (const Interrupted&) {
        is_stopped = true;
      }
    });
    other.join();
    CHECK(is_stopped);
  }
}

TEST_CASE("a time limit of nothing stops at once, and none never") {
  for (const double none : {0.0, -1.0}) {
    const TimeLimit over(none);
    CHECK_THROWS_AS(over.monitor().check_interruption(), Interrupted);
  }
  for (const std::optional<double>& most : {std::optional<double>(), std::optional(1e300)}) {
    std::atomic<bool> stop{false};
    const TimeLimit limit(most, Monitor().stopped_by(&stop));
    for (int i = 0; i < 100; ++i) CHECK_NOTHROW(limit.monitor().check_interruption());
    stop = true;
    CHECK_THROWS_AS(limit.monitor().check_interruption(), Interrupted);
    CHECK_THROWS_AS(limit.monitor().of_other_thread().check_interruption(), Interrupted);
  }
}

}  // namespace nef

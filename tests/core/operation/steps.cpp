// SPDX-License-Identifier: Apache-2.0
//
// Steps of a loop that wait until somebody looks: the sets are those of unite and subtract, whoever looks at whichever
// of them, whenever.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "nef/base/interruption.h"
#include "nef/construct/construct.h"
#include "nef/operators.h"
#include "nef/polyhedron.h"

namespace nef::test {
namespace {

// Bars side by side, so large that boxes are small beside them.
Polyhedron bars(long count) {
  std::vector<Polyhedron> all;
  for (long i = 0; i < count; ++i) all.push_back(make_box({3 * i, 0, 0}, {3 * i + 2, 40, 3}));
  return unite_all(all);
}

Polyhedron random_box(std::mt19937& random) {
  const auto below = [&random](long n) { return static_cast<long>(random() % static_cast<unsigned long>(n)); };
  const long x = below(60) - 2;
  const long y = below(42) - 2;
  const long z = below(5) - 1;
  return make_box({x, y, z}, {x + 1 + below(4), y + 1 + below(4), z + 1 + below(3)});
}

TEST_CASE("Steps that wait make the sets of unite and subtract", "[steps]") {
  std::mt19937 random(5);
  for (int round = 0; round < 6; ++round) {
    Polyhedron steps = bars(20);
    Polyhedron at_once = steps;
    std::vector<std::pair<Polyhedron, Polyhedron>> kept;  // versions that somebody holds, looked at late or never
    for (int i = 0; i < 40; ++i) {
      const Polyhedron box = random_box(random);
      const bool unites = random() % 3 == 0;
      steps = unites ? steps + box : steps - box;
      at_once = unites ? unite(at_once, box) : subtract(at_once, box);
      if (random() % 4 == 0) kept.emplace_back(steps, at_once);
      if (random() % 16 == 0) CHECK(equal(steps, at_once));
    }
    std::shuffle(kept.begin(), kept.end(), random);
    for (const auto& [step, whole] : kept) {
      if (random() % 2 == 0) CHECK(equal(step, whole));
    }
    CHECK(equal(steps, at_once));
    CHECK(validate(steps.complex()).empty());
    CHECK(counts(steps).vertices == counts(at_once).vertices);
  }
}

TEST_CASE("A step waits beside a set of eight times its vertices, and what waits stays as small as that set",
          "[steps]") {
  const Polyhedron base = bars(20);
  REQUIRE(base.complex().vertex_count() == 160);
  const Polyhedron box = make_box({0, 0, 2}, {1, 1, 5});
  CHECK((base - box).waits());
  CHECK((base + box).waits());
  CHECK((bars(8) - box).waits());
  CHECK_FALSE((bars(7) - box).waits());
  CHECK_FALSE((base - Polyhedron()).waits());
  CHECK_FALSE((base - box + box).waits());  // of two kinds
  CHECK((base - Polyhedron::everything()).is_empty());
  CHECK((base + Polyhedron::everything()).is_everything());
  Polyhedron steps = base;
  for (long i = 0; i < 21; ++i) {
    steps = steps - make_box({3 * (i % 20), i / 20, 2}, {3 * (i % 20) + 1, i / 20 + 1, 3});
    CHECK(steps.waits() == (i < 20));  // 20 boxes have as many vertices as the bars
  }
  CHECK(volume(steps).value() == 20 * 240 - 21);
  for (long i = 21; i < 200; ++i) {
    steps -= make_box({3 * (i % 20), i / 20, 2}, {3 * (i % 20) + 1, i / 20 + 1, 3});
  }
  CHECK(steps.waits());
  steps.compute(Monitor().on_threads(2));
  CHECK_FALSE(steps.waits());
  CHECK(volume(steps).value() == 20 * 240 - 200);
}

TEST_CASE("Threads look at the same steps, and at those behind them, at once", "[steps][threads]") {
  for (int round = 0; round < 5; ++round) {
    std::vector<Polyhedron> versions{bars(20)};
    for (long i = 0; i < 16; ++i) versions.push_back(versions.back() - make_box({3 * i, i, 2}, {3 * i + 1, i + 1, 3}));
    std::atomic<int> wrong = 0;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
      threads.emplace_back([&versions, &wrong, t] {
        for (std::size_t i = 0; i < versions.size(); ++i) {
          const std::size_t k = t % 2 == 0 ? i : versions.size() - 1 - i;
          if (volume(versions[k]).value() != Rational(20 * 240 - static_cast<long>(k))) ++wrong;
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(wrong == 0);
  }
}

TEST_CASE("A long loop may end without a look", "[steps]") {
  // Rings of many corners, so that many steps may wait.
  Polyhedron large = bars(1);
  std::vector<Polyhedron> pegs;
  for (long i = 0; i < 2000; ++i) pegs.push_back(make_box({4 * i, 50, 0}, {4 * i + 1, 51, 1}));
  large = unite(large, unite_all(pegs));
  const Polyhedron peg = make_box({0, 60, 0}, {1, 61, 1});
  for (int rounds = 0; rounds < 20; ++rounds) {
    Polyhedron steps = large;
    for (int i = 0; i < 1900; ++i) steps += peg;
    CHECK(steps.waits());
  }
}

TEST_CASE("A look that is stopped leaves the steps to the next one", "[steps]") {
  const Polyhedron base = bars(20);
  const Polyhedron box = make_box({0, 0, 2}, {1, 1, 5});
  const Polyhedron steps = base - box - make_box({3, 0, 2}, {4, 1, 5});
  const std::atomic<bool> stop = true;
  CHECK_THROWS_AS(steps.compute(Monitor().stopped_by(&stop)), Interrupted);
  CHECK(volume(steps).value() == 20 * 240 - 2);
  Polyhedron given = base - box;
  const Complex taken = std::move(given).take_complex();
  CHECK(given.is_empty());  // NOLINT(bugprone-use-after-move): it is the empty set then
  CHECK(equal(Polyhedron(Complex(taken)), subtract(base, box)));
}

}  // namespace
}  // namespace nef::test

// SPDX-License-Identifier: Apache-2.0
//
// Unions of many sets: the order in which pairs are united, and that nobody sees it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>
#include <vector>

#include "nef/boolean/union_order.h"
#include "nef/construct/construct.h"
#include "nef/io/native/native_binary.h"
#include "nef/operation/canonical_order.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

using Members = std::vector<std::uint32_t>;

UnionOperand on_the_line(double x, std::size_t weight = 1) {
  UnionOperand operand;
  operand.box.low = {x, 0, 0};
  operand.box.high = {x + 1, 1, 1};
  operand.weight = weight;
  return operand;
}

// The operands of each result, sorted, in the order of the steps, in which every set is used once and after it is made.
std::vector<Members> members(const UnionOrder& order, std::size_t operands) {
  std::vector<Members> of_step;
  std::set<std::uint32_t> used;
  for (const UnionOrder::Step& step : order.steps()) {
    Members all;
    for (const std::uint32_t i : {step.first, step.second}) {
      REQUIRE(i < operands + of_step.size());
      CHECK(used.insert(i).second);
      const Members part = i < operands ? Members{i} : of_step[i - operands];
      all.insert(all.end(), part.begin(), part.end());
    }
    std::sort(all.begin(), all.end());
    of_step.push_back(std::move(all));
  }
  CHECK(of_step.size() + 1 == operands);
  CHECK(of_step.back().size() == operands);
  return of_step;
}

// Tasks and rounds do every step once, and nothing before what it needs.
void tasks_and_rounds_do_all(const UnionOrder& order, std::size_t operands) {
  std::vector<bool> done(operands + order.steps().size(), false);
  std::fill_n(done.begin(), operands, true);
  const auto needs = [&](std::uint32_t k) {
    return done[order.steps()[k].first] && done[order.steps()[k].second] && !done[operands + k];
  };
  for (const UnionOrder::Task& task : order.tasks()) {
    const std::vector<bool> before = done;
    for (std::uint32_t k = task.first; k < task.last; ++k) {
      // Of its own, or an operand.
      for (const std::uint32_t i : {order.steps()[k].first, order.steps()[k].second}) {
        CHECK((i < operands || i - operands >= task.first));
      }
      CHECK(needs(k));
      done[operands + k] = true;
    }
  }
  for (const std::vector<std::uint32_t>& round : order.rounds()) {
    for (const std::uint32_t k : round) CHECK(needs(k));
    for (const std::uint32_t k : round) done[operands + k] = true;
  }
  CHECK(std::count(done.begin(), done.end(), false) == 0);
}

std::vector<Polyhedron> random_boxes(int count, int side) {
  std::mt19937 random(7);
  const auto below = [&random](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
  std::vector<Polyhedron> sets;
  for (int i = 0; i < count; ++i) {
    const int x = below(side);
    const int y = below(side);
    const int z = below(side);
    Polyhedron box = make_box({x, y, z}, {x + below(3), y + 1 + below(2), z + 1});
    sets.push_back(i % 5 == 0 ? interior(box) : box);
  }
  return sets;
}

}  // namespace

TEST_CASE("neighbours are united first", "[unite_all]") {
  std::vector<UnionOperand> operands;
  std::vector<std::uint32_t> places(500);
  for (std::uint32_t i = 0; i < places.size(); ++i) places[i] = i;
  std::shuffle(places.begin(), places.end(), std::mt19937(1));
  for (const std::uint32_t place : places) operands.push_back(on_the_line(place));
  const UnionOrder order(operands);
  for (const Members& some : members(order, operands.size())) {
    std::vector<std::uint32_t> at;
    for (const std::uint32_t i : some) at.push_back(places[i]);
    const auto [low, high] = std::minmax_element(at.begin(), at.end());
    CHECK(*high - *low + 1 == at.size());  // all that lie between
  }
  CHECK(order.tasks().size() >= 64);
  CHECK(order.rounds().size() <= 8);
  tasks_and_rounds_do_all(order, operands.size());
}

TEST_CASE("a set that outweighs the others waits for them, and an unbounded one for all", "[unite_all]") {
  std::vector<UnionOperand> operands{on_the_line(20, 1000), on_the_line(0), on_the_line(1)};
  operands.push_back({{}, 1, false});
  for (int i = 0; i < 50; ++i) operands.push_back(on_the_line(2 + i));
  const UnionOrder order(operands);
  const std::vector<Members> all = members(order, operands.size());
  CHECK(order.steps().back().second == 3);
  CHECK(order.steps()[all.size() - 2].second == 0);
  CHECK(all[all.size() - 3].size() == operands.size() - 2);
}

TEST_CASE("any weights and places make an order", "[unite_all]") {
  std::mt19937 random(3);
  for (int turn = 0; turn < 300; ++turn) {
    const std::size_t count = 1 + random() % (turn % 10 == 0 ? 700 : 12);
    std::vector<UnionOperand> operands;
    for (std::size_t i = 0; i < count; ++i) {
      operands.push_back(on_the_line(static_cast<double>(random() % 6), 1 + (std::size_t{1} << random() % 20)));
      operands.back().bounded = random() % 4 != 0;
      if (random() % 8 == 0) operands.back().box = Box();  // empty
    }
    const UnionOrder order(operands);
    if (count == 1) {
      CHECK(order.steps().empty());
      continue;
    }
    members(order, count);
    tasks_and_rounds_do_all(order, count);
  }
}

TEST_CASE("the union of many sets is the same for any order of them, item for item for any number of threads",
          "[unite_all][parallel]") {
  std::vector<Polyhedron> sets = random_boxes(700, 8);
  sets.push_back(make_halfspace(1, 0, 0, 1));
  sets.push_back(Polyhedron());
  const Polyhedron one = unite_all(sets);
  const std::string bytes = native_binary(one);
  CHECK(native_binary(unite_all(sets, Monitor().on_threads(2))) == bytes);
  CHECK(native_binary(unite_all(sets, Monitor().on_threads(5))) == bytes);
  CHECK(native_binary(unite_all(sets, Monitor().on_threads(0))) == bytes);
  Polyhedron folded;
  for (const Polyhedron& set : sets) folded = unite(folded, set);
  const std::string canonical = native_binary(in_canonical_order(one));
  CHECK(native_binary(in_canonical_order(folded)) == canonical);
  for (unsigned seed = 1; seed <= 2; ++seed) {
    std::shuffle(sets.begin(), sets.end(), std::mt19937(seed));
    CHECK(native_binary(in_canonical_order(unite_all(sets))) == canonical);
  }
  sets.push_back(Polyhedron::everything());
  CHECK(unite_all(sets).is_everything());
}

}  // namespace nef

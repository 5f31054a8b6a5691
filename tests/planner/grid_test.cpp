// SPDX-License-Identifier: Apache-2.0
//
// Random scenes of boxes on a small grid against a decision that shares nothing with the planner: the planes, lines
// and points of the grid cut space into cells that are free or not as a whole, and a breadth-first search over them
// finds components, reachability and T. PLANNER_SEEDS in the environment asks for more seeds than the default.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <random>

#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

using Cell = std::array<int, 3>;  // even: a plane at half of it; odd: the open interval between two planes
struct GridBox {
  Cell low, high;  // in whole units
};

constexpr int kLow = -10;  // doubled coordinates of what is looked at; everything happens well inside
constexpr int kHigh = 20;
constexpr int kSpan = kHigh - kLow + 1;

// The arrangement with the open boxes (closed ones if contact is forbidden) taken out.
class Arrangement {
 public:
  Arrangement(const std::vector<GridBox>& taken, bool closed) : free_(kSpan * kSpan * kSpan, true) {
    for_each([&](const Cell& c) {
      for (const GridBox& box : taken) {
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
          const int low = 2 * box.low[i];
          const int high = 2 * box.high[i];
          inside = inside && (closed ? c[i] >= low && c[i] <= high : c[i] > low && c[i] < high);
        }
        if (inside) free_[index(c)] = false;
      }
    });
    find_local_dimensions();
  }

  [[nodiscard]] bool is_free(const Cell& c) const { return free_[index(c)]; }
  [[nodiscard]] int local_dimension(const Cell& c) const { return local_[index(c)]; }

  // Component of each cell whose free space is locally at least k-dimensional; -1 for others.
  [[nodiscard]] std::vector<int> components(int k, int& count) const {
    std::vector<int> component(free_.size(), -1);
    count = 0;
    for_each([&](const Cell& seed) {
      if (!free_[index(seed)] || local_[index(seed)] < k || component[index(seed)] >= 0) return;
      std::vector<Cell> stack{seed};
      component[index(seed)] = count;
      while (!stack.empty()) {
        const Cell c = stack.back();
        stack.pop_back();
        for_each_incident(c, [&](const Cell& n) {
          if (!free_[index(n)] || local_[index(n)] < k || component[index(n)] >= 0) return;
          component[index(n)] = count;
          stack.push_back(n);
        });
      }
      ++count;
    });
    return component;
  }

  static std::size_t index(const Cell& c) {
    return static_cast<std::size_t>(((c[0] - kLow) * kSpan + (c[1] - kLow)) * kSpan + (c[2] - kLow));
  }

 private:
  template <typename Visit>
  static void for_each(const Visit& visit) {
    for (int x = kLow; x <= kHigh; ++x) {
      for (int y = kLow; y <= kHigh; ++y) {
        for (int z = kLow; z <= kHigh; ++z) visit(Cell{x, y, z});
      }
    }
  }
  static bool odd(int x) { return (x & 1) != 0; }
  static int dimension(const Cell& c) { return odd(c[0]) + odd(c[1]) + odd(c[2]); }

  // Cells of which one lies in the closure of the other: all coordinates that change go from odd to even, or all from
  // even to odd.
  template <typename Visit>
  static void for_each_incident(const Cell& c, const Visit& visit) {
    for (int code = 0; code < 27; ++code) {
      const Cell d{code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
      bool down = true;
      bool up = true;
      bool inside = code != 13;
      for (std::size_t i = 0; i < 3; ++i) {
        if (d[i] != 0) (odd(c[i]) ? up : down) = false;
        inside = inside && c[i] + d[i] >= kLow && c[i] + d[i] <= kHigh;
      }
      if (inside && (down || up)) visit(Cell{c[0] + d[0], c[1] + d[1], c[2] + d[2]});
    }
  }
  void find_local_dimensions() {
    local_.assign(free_.size(), -1);
    for_each([&](const Cell& c) {
      if (!free_[index(c)]) return;
      int best = dimension(c);
      for_each_incident(c, [&](const Cell& n) {
        if (free_[index(n)]) best = std::max(best, dimension(n));
      });
      local_[index(c)] = best;
    });
  }

  std::vector<bool> free_;
  std::vector<int> local_;
};

struct RandomScene {
  std::vector<GridBox> robot;
  std::vector<GridBox> obstacles;
  std::vector<GridBox> taken;  // per pair: obstacle + -robot
};

RandomScene random_scene(std::mt19937& random) {
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  RandomScene scene;
  const Cell size{number(1, 2), number(1, 2), number(1, 2)};
  scene.robot.push_back({{0, 0, 0}, size});
  if (number(0, 2) == 0) scene.robot.push_back({{0, 0, size[2]}, {1, 1, size[2] + 1}});
  const int count = number(3, 9);
  for (int i = 0; i < count; ++i) {
    GridBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = number(0, 4);
      box.high[k] = std::min(6, box.low[k] + number(1, 5));
    }
    scene.obstacles.push_back(box);
  }
  // Now and then a closed shell, so that something is enclosed.
  if (number(0, 1) == 0) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const int at : {-1, 6}) {
        GridBox wall{{-1, -1, -1}, {7, 7, 7}};
        wall.low[k] = at;
        wall.high[k] = at + 1;
        scene.obstacles.push_back(wall);
      }
    }
  }
  for (const GridBox& o : scene.obstacles) {
    for (const GridBox& r : scene.robot) {
      GridBox box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = o.low[k] - r.high[k];
        box.high[k] = o.high[k] - r.low[k];
      }
      scene.taken.push_back(box);
    }
  }
  return scene;
}

Polyhedron solid(const std::vector<GridBox>& boxes) {
  std::vector<Polyhedron> parts;
  for (const GridBox& box : boxes) {
    parts.push_back(make_box({box.low[0], box.low[1], box.low[2]}, {box.high[0], box.high[1], box.high[2]}));
  }
  return unite_all(parts);
}

Rational3 point_of_cell(const Cell& c) {
  Rational3 point{Rational(c[0], 2), Rational(c[1], 2), Rational(c[2], 2)};
  for (Rational& value : point) value.canonicalize();
  return point;
}

Location::Kind kind_of(int dimension) { return static_cast<Location::Kind>(dimension); }

void check_scene(unsigned seed, bool forbid) {
  INFO("seed " << seed << (forbid ? ", contact forbidden" : ""));
  std::mt19937 random(seed);
  const RandomScene grid = random_scene(random);
  Scene scene;
  scene.robot = solid(grid.robot);
  for (const GridBox& box : grid.obstacles) scene.obstacles.push_back(solid({box}));
  scene.obstacle_names.assign(scene.obstacles.size(), "box");
  scene.contact = forbid ? ContactRule::kForbid : ContactRule::kAllow;
  const Problem problem(scene);
  const FreeSpace& free = problem.free_space();
  const Arrangement truth(grid.taken, forbid);
  int count = 0;
  const std::vector<int> component = truth.components(0, count);
  CHECK(free.components().size() == static_cast<std::size_t>(count));

  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int pair = 0; pair < 6; ++pair) {
    const Cell a{number(-4, 13), number(-4, 13), number(-4, 13)};
    const Cell b{number(-4, 13), number(-4, 13), number(-4, 13)};
    const Rational3 start = point_of_cell(a);
    const Rational3 goal = point_of_cell(b);
    const CellId cell = free.locate(ExactPoint(start));
    CHECK(free.is_free(cell) == truth.is_free(a));
    const Location location = locate(free.set(), start);
    CHECK(location.kind == kind_of(free.cells().dimension(cell)));
    if (free.is_free(cell)) CHECK(free.local_dimension(cell) == truth.local_dimension(a));
    if (!truth.is_free(a) || !truth.is_free(b)) continue;
    PathOptions quick;
    quick.thorough = false;
    const Answer answer = problem.solve(start, goal, quick);
    const bool reachable = component[Arrangement::index(a)] == component[Arrangement::index(b)];
    CHECK((answer.status == Answer::Status::kPath) == reachable);
    if (!answer.path) continue;
    int thinnest = 3;
    for (; thinnest > 0; --thinnest) {
      int ignored = 0;
      const std::vector<int> thick = truth.components(thinnest, ignored);
      const int at = thick[Arrangement::index(a)];
      if (at >= 0 && at == thick[Arrangement::index(b)]) break;
    }
    CHECK(answer.thinness->piece == thinnest);
    CHECK(answer.path->points.front() == start);
    CHECK(answer.path->points.back() == goal);
    if (pair == 0) CHECK(independent_complaint(scene, free.set(), *answer.path, !forbid) == "");
  }
}

unsigned seeds() {
  const char* text = std::getenv("PLANNER_SEEDS");
  return text != nullptr ? static_cast<unsigned>(std::strtoul(text, nullptr, 10)) : 40U;
}

TEST_CASE("random boxes on a grid, contact allowed, against breadth-first search") {
  for (unsigned seed = 0; seed < seeds(); ++seed) check_scene(seed, false);
}

TEST_CASE("random boxes on a grid, contact forbidden, against breadth-first search") {
  for (unsigned seed = 0; seed < seeds() / 2; ++seed) check_scene(seed + 1000000, true);
}

}  // namespace
}  // namespace nef::planner::test

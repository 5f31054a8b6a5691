// SPDX-License-Identifier: Apache-2.0
//
// What collides: a point of one set that is not on its border meets such a point of the other. Robots and obstacles
// of all dimensions on a small grid, against a decision that counts cells and knows neither sphere maps nor sums.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <set>

#include "apps/minkowski/minkowski.h"
#include "tests/planner/grid_arrangement.h"
#include "tests/planner/scene_helpers.h"

namespace nef::planner::test {
namespace {

// A closed set of grid cells: even coordinates are planes at half of them, odd ones open intervals between two.
using CellSet = std::set<Cell>;

bool is_odd(int x) { return (x & 1) != 0; }

int dimension_of(const Cell& c) { return static_cast<int>(std::count_if(c.begin(), c.end(), is_odd)); }

void add_box(const Cell& low, const Cell& high, CellSet& to) {
  for (int x = 2 * low[0]; x <= 2 * high[0]; ++x) {
    for (int y = 2 * low[1]; y <= 2 * high[1]; ++y) {
      for (int z = 2 * low[2]; z <= 2 * high[2]; ++z) to.insert({x, y, z});
    }
  }
}

// The cells that have c in their closure, c itself left out.
template <typename Visit>
void for_star(const Cell& c, const Visit& visit) {
  for (int code = 0; code < 27; ++code) {
    const Cell step{code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1};
    bool holds = code != 13;
    Cell d = c;
    for (std::size_t k = 0; k < 3; ++k) {
      holds = holds && (step[k] == 0 || !is_odd(c[k]));
      d[k] += step[k];
    }
    if (holds) visit(d);
  }
}

bool in_closure(const Cell& c, const Cell& of) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (c[k] != of[k] && (is_odd(c[k]) || std::abs(c[k] - of[k]) != 1)) return false;
  }
  return true;
}

bool in_solid_part(const CellSet& set, const Cell& c) {
  bool found = dimension_of(c) == 3;
  for_star(c, [&](const Cell& d) { found = found || (dimension_of(d) == 3 && set.count(d) != 0); });
  return found;
}

bool on_border(const CellSet& set, const Cell& c) {
  std::vector<Cell> star;
  bool whole = true;
  for_star(c, [&](const Cell& d) {
    if (set.count(d) != 0) {
      star.push_back(d);
    } else {
      whole = false;
    }
  });
  if (whole) return false;
  const auto solid = [&](const Cell& d) { return in_solid_part(set, d); };
  if (solid(c) && std::all_of(star.begin(), star.end(), solid)) return true;
  // The link has a cell one dimension lower for each of the star: one component and no loop?
  int euler = 0;
  for (const Cell& d : star) euler += (dimension_of(d) - dimension_of(c)) % 2 == 1 ? 1 : -1;
  std::vector<Cell> reached;
  if (!star.empty()) reached.push_back(star.front());
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (const Cell& d : star) {
      const Cell at = reached[next];
      if ((in_closure(d, at) || in_closure(at, d)) && std::find(reached.begin(), reached.end(), d) == reached.end()) {
        reached.push_back(d);
      }
    }
  }
  return !star.empty() && reached.size() == star.size() && euler == 1;
}

CellSet inner(const CellSet& set) {
  CellSet result;
  for (const Cell& c : set) {
    if (!on_border(set, c)) result.insert(c);
  }
  return result;
}

Polyhedron polyhedron(const CellSet& closed) {
  std::vector<Polyhedron> parts;
  for (const Cell& c : closed) {
    const auto down = [](int x) { return (x - (is_odd(x) ? 1 : 0)) / 2; };
    const auto up = [](int x) { return (x + (is_odd(x) ? 1 : 0)) / 2; };
    parts.push_back(make_box({down(c[0]), down(c[1]), down(c[2])}, {up(c[0]), up(c[1]), up(c[2])}));
  }
  return unite_all(parts);
}

// The positions at which relatively open cells c of an obstacle and d of the robot meet: c - d.
Arrangement::Range difference(const Cell& c, const Cell& d) {
  Arrangement::Range range;
  for (std::size_t k = 0; k < 3; ++k) {
    const int spread = is_odd(c[k]) && is_odd(d[k]) ? 1 : 0;  // the difference of two open intervals is two long
    range[0][k] = c[k] - d[k] - spread;
    range[1][k] = c[k] - d[k] + spread;
  }
  return range;
}

// Boxes of given dimension, each between 0 and `span` with sides of 1 or 2.
CellSet random_set(std::mt19937& random, int dimension, int count, int span) {
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  CellSet set;
  for (int i = 0; i < count; ++i) {
    std::array<std::size_t, 3> axes{0, 1, 2};
    std::shuffle(axes.begin(), axes.end(), random);
    Cell low{};
    Cell high{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t axis = axes[k];
      const int size = static_cast<int>(k) < dimension ? number(1, std::min(2, span)) : 0;
      low[axis] = number(0, span - size);
      high[axis] = low[axis] + size;
    }
    add_box(low, high, set);
  }
  return set;
}

struct GridSets {
  CellSet robot;
  std::vector<CellSet> obstacles;
};

Scene scene_of_sets(const GridSets& sets) {
  Scene scene;
  scene.robot = polyhedron(sets.robot);
  for (const CellSet& obstacle : sets.obstacles) scene.obstacles.push_back(polyhedron(obstacle));
  scene.obstacle_names.assign(scene.obstacles.size(), "set");
  return scene;
}

Arrangement truth_of(const GridSets& sets) {
  CellSet all;
  CellSet obstacles;
  for (const CellSet& obstacle : sets.obstacles) {
    all.insert(obstacle.begin(), obstacle.end());
    obstacles.merge(inner(obstacle));
  }
  obstacles.merge(inner(all));
  const CellSet robot = inner(sets.robot);
  std::vector<Arrangement::Range> taken;
  for (const Cell& c : obstacles) {
    for (const Cell& d : robot) taken.push_back(difference(c, d));
  }
  return Arrangement(taken);
}

void check(const GridSets& sets, std::mt19937& random) {
  const Scene scene = scene_of_sets(sets);
  const Arrangement truth = truth_of(sets);
  const FreeSpace free(free_positions(scene));
  int count = 0;
  const std::vector<int> components = truth.components(0, count);
  const std::vector<Cell> special = compare_all(free, truth, components, count);
  // Paths between what the cells join, and what is named where a position is taken.
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int i = 0; i < 8; ++i) {
    const auto some = [&] {
      if (special.empty() || i % 2 == 0) return Cell{number(-6, 8), number(-6, 8), number(-6, 8)};
      return special[static_cast<std::size_t>(number(0, static_cast<int>(special.size()) - 1))];
    };
    const auto point = [](const Cell& c) {
      return Rational3{Rational(c[0]) / 2, Rational(c[1]) / 2, Rational(c[2]) / 2};
    };
    const Cell a = some();
    const Cell b = some();
    CHECK(find_collision(scene, point(a)).has_value() != truth.is_free(a));
    if (!truth.is_free(a) || !truth.is_free(b)) continue;
    const bool reachable = components[Arrangement::index(a)] == components[Arrangement::index(b)];
    const std::optional<ExactPath> path = find_path(free, point(a), point(b), {});
    CHECK(path.has_value() == reachable);
    if (path) CHECK(independent_complaint(scene, free.set(), *path, false) == "");
  }
}

TEST_CASE("collision in all pairs of dimensions, against counting cells of a grid") {
  for (int robot = 0; robot <= 3; ++robot) {
    for (int obstacle = 0; obstacle <= 3; ++obstacle) {
      for (unsigned seed = 0; seed < seeds(4); ++seed) {
        INFO("robot " << robot << ", obstacles " << obstacle << ", seed " << seed);
        std::mt19937 random(seed);
        GridSets sets;
        sets.robot = random_set(random, robot, 1 + static_cast<int>(seed % 2), 2);
        for (unsigned i = 0; i < 1 + seed % 3; ++i) sets.obstacles.push_back(random_set(random, obstacle, 2, 3));
        check(sets, random);
      }
    }
  }
}

TEST_CASE("collision of sets of mixed dimension, against counting cells of a grid") {
  for (unsigned seed = 0; seed < seeds(20); ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto mixed = [&](int span) {
      CellSet set = random_set(random, static_cast<int>(random() % 4), 1, span);
      set.merge(random_set(random, static_cast<int>(random() % 4), 2, span));
      return set;
    };
    GridSets sets;
    sets.robot = mixed(1 + static_cast<int>(seed % 2));
    for (unsigned i = 0; i < 1 + seed % 2; ++i) sets.obstacles.push_back(mixed(3));
    check(sets, random);
  }
}

Polyhedron shape(const std::string& expression) {
  return parse_scene(R"J({"robot": ")J" + expression + R"J(", "obstacles": []})J", "", "test").robot;
}

bool collides(const std::string& robot, const std::string& obstacle, const Rational3& at) {
  Scene scene;
  scene.robot = shape(robot);
  scene.obstacles.push_back(shape(obstacle));
  scene.obstacle_names.emplace_back("it");
  const bool taken = !contains(free_positions(scene), at);
  CHECK(find_collision(scene, at).has_value() == taken);
  return taken;
}

TEST_CASE("what touches and what collides, case by case") {
  const std::string sheet = "polygon((0,0,0),(4,0,0),(4,4,0),(0,4,0))";
  const std::string fold = sheet + " + polygon((0,0,0),(4,0,0),(4,0,4),(0,0,4))";
  const std::string fixed = "box(0,0,-4, 4,4,0) + polygon((2,0,0),(2,4,0),(2,4,3),(2,0,3))";
  const std::string fly = "point(0,0,0)";
  const std::string stick = "segment(0,0,-1, 0,0,1)";
  // Surfaces.
  CHECK(collides(fly, sheet, {1, 1, 0}));
  CHECK_FALSE(collides(fly, sheet, {0, 1, 0}));
  CHECK(collides(stick, sheet, {1, 1, 0}));
  CHECK_FALSE(collides(stick, sheet, {1, 1, 1}));  // its end
  CHECK(collides(sheet, sheet, {1, 1, 0}));        // parallel sheets do not pass through each other
  CHECK_FALSE(collides(sheet, sheet, {4, 0, 0}));  // edges may touch
  CHECK(collides(fly, fold, {1, 0, 0}));           // a fold is no rim
  CHECK_FALSE(collides(fly, fold, {0, 0, 0}));     // but its end is
  CHECK(collides(fly, "boundary(box(0,0,0, 1,1,1))", {0, 0, 0}));
  CHECK_FALSE(collides(fly, "boundary(box(0,0,0, 1,1,1))", {Rational(1, 2), Rational(1, 2), Rational(1, 2)}));
  // Curves and points.
  CHECK(collides(fly, fly, {0, 0, 0}));
  CHECK(collides(fly, stick, {0, 0, 0}));
  CHECK_FALSE(collides(fly, stick, {0, 0, 1}));
  CHECK(collides(fly, stick + " + segment(0,0,1, 1,0,1)", {0, 0, 1}));
  CHECK(collides(stick, "segment(-1,0,0, 1,0,0)", {0, 0, 0}));
  CHECK_FALSE(collides(stick, "segment(-1,0,0, 1,0,0)", {0, 0, 1}));
  // Solids: contact is free; what is fixed to them leaves no gap.
  CHECK_FALSE(collides(fly, fixed, {1, 1, 0}));
  CHECK(collides(fly, fixed, {1, 1, -1}));
  CHECK(collides(fly, fixed, {2, 1, 0}));
  CHECK_FALSE(collides(fly, fixed, {2, 0, 0}));  // where the sheet's rim ends on the solid
  CHECK(collides(sheet, "box(0,0,0, 1,1,1) + segment(1/2,1/2,1, 1/2,1/2,2)", {-1, -1, 1}));
  CHECK_FALSE(collides(fly, "box(0,0,0, 1,1,1) + box(1,1,0, 2,2,1)", {1, 1, Rational(1, 2)}));
  // A sheet's corner against the middle of another: they are joined, so there is no pinhole in that one.
  CHECK(collides(fly, sheet + " + polygon((1,1,0),(2,1,1),(1,2,1))", {1, 1, 0}));
}

TEST_CASE("sets without end have no border at infinity") {
  using minkowski::without_border;
  const auto set = [](const std::string& text) {
    const std::string scene = R"J({"robot": "point(0,0,0)", "obstacles": [")J" + text + R"J("]})J";
    return parse_scene(scene, "", "test").obstacles.at(0);
  };
  CHECK(equal(without_border(set("halfspace(0,0,1,0)")), interior(set("halfspace(0,0,1,0)"))));
  const Polyhedron plane = set("boundary(halfspace(0,0,1,0))");
  CHECK(equal(without_border(plane), plane));
  const Polyhedron half = set("boundary(halfspace(0,0,1,0)) * halfspace(1,0,0,0)");
  CHECK(
      equal(without_border(half), subtract(half, set("boundary(halfspace(0,0,1,0)) * boundary(halfspace(1,0,0,0))"))));
  const Polyhedron cross = set("boundary(halfspace(0,0,1,0)) + boundary(halfspace(1,0,0,0))");
  CHECK(equal(without_border(cross), cross));
  for (const Polyhedron& s : {plane, half, cross}) CHECK(validate(without_border(s).complex()).empty());
}

}  // namespace
}  // namespace nef::planner::test

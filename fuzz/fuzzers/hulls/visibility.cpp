// SPDX-License-Identifier: Apache-2.0
//
// Convex prisms and a convex prism as robot: a problem in the plane, which a visibility graph decides exactly. The
// forbidden positions are the open sums of obstacles and the mirrored robot, a shortest path bends at their corners
// only.
#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/planner/path/question.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "tests/support/shapes/oblique_rotation.h"

namespace nef::fuzz {
namespace {

using Planar = std::array<Rational, 2>;
using Polygon = std::vector<Planar>;

int turn_of(const Planar& a, const Planar& b, const Planar& c) {
  return sgn(Rational((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])));
}

// Gift wrapping, counterclockwise; empty if the points are collinear.
Polygon convex_polygon_of(const Polygon& points) {
  const Planar first = *std::min_element(points.begin(), points.end());
  Polygon hull;
  Planar at = first;
  do {
    hull.push_back(at);
    Planar next = at;
    for (const Planar& p : points) {
      if (p == at) continue;
      const auto reach = [&](const Planar& q) { return Rational(abs(q[0] - at[0]) + abs(q[1] - at[1])); };
      const int side = next == at ? -1 : turn_of(at, next, p);
      if (side < 0 || (side == 0 && reach(p) > reach(next))) next = p;
    }
    at = next;
  } while (at != first && hull.size() <= points.size());
  return hull.size() < 3 ? Polygon{} : hull;
}

// The segment meets the inside of the polygon: Cyrus and Beck's clipping, with open half-planes.
bool enters(const Polygon& polygon, const Planar& a, const Planar& b) {
  Rational least = 0;
  Rational most = 1;
  bool some = true;  // an interval of one point is open or not as the segment's ends are: they are not
  for (std::size_t i = 0; i < polygon.size() && some; ++i) {
    const Planar& p = polygon[i];
    const Planar& q = polygon[(i + 1) % polygon.size()];
    const auto height = [&](const Planar& x) {
      return Rational((q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0]));
    };
    const Rational from = height(a);
    const Rational to = height(b);
    if (from <= 0 && to <= 0) return false;
    if (from > 0 && to > 0) continue;
    const Rational t = from / (from - to);
    if (from <= 0) {
      least = std::max(least, t);
    } else {
      most = std::min(most, t);
    }
    some = least < most;
  }
  return some;
}

double distance(const Planar& a, const Planar& b) {
  return std::hypot(Rational(a[0] - b[0]).get_d(), Rational(a[1] - b[1]).get_d());
}

// The length of a shortest path in the closed complement of the open polygons, infinite if there is none.
double shortest(const std::vector<Polygon>& taken, const Planar& start, const Planar& goal, int half) {
  std::vector<Planar> nodes{start, goal};
  for (const Polygon& polygon : taken) {
    for (const Planar& p : polygon) {
      if (abs(p[0]) <= half && abs(p[1]) <= half) nodes.push_back(p);
    }
  }
  const auto visible = [&](const Planar& a, const Planar& b) {
    return std::none_of(taken.begin(), taken.end(), [&](const Polygon& polygon) { return enters(polygon, a, b); });
  };
  std::vector<double> length(nodes.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(nodes.size(), false);
  length[0] = 0;
  for (;;) {  // Dijkstra's algorithm on a dense graph
    std::size_t best = nodes.size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!done[i] && std::isfinite(length[i]) && (best == nodes.size() || length[i] < length[best])) best = i;
    }
    if (best == nodes.size() || best == 1) return length[1];
    done[best] = true;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const double way = length[best] + distance(nodes[best], nodes[i]);
      if (!done[i] && way < length[i] && visible(nodes[best], nodes[i])) length[i] = way;
    }
  }
}

Planar random_planar(Choices& choices, int low, int high) {
  return {Rational(choices.between(low, high)), Rational(choices.between(low, high))};
}

Polygon random_polygon(Choices& choices, int low, int high) {
  Polygon points;
  for (std::uint32_t i = 3 + choices.below(4); i > 0; --i) points.push_back(random_planar(choices, low, high));
  Polygon hull = convex_polygon_of(points);
  if (!hull.empty()) return hull;
  const Planar p = points.front();
  return {p, {p[0] + 1, p[1]}, {p[0], p[1] + 1}};
}

Polyhedron prism(const Polygon& base, int bottom, int top, const AffineMap& map) {
  std::vector<Rational3> points;
  for (const Planar& p : base) {
    for (const int z : {bottom, top}) points.push_back(map({p[0], p[1], z}));
  }
  return convex_hull(points);
}

std::string text_of(const Polygon& polygon) {
  std::string text;
  for (const Planar& p : polygon) text += " (" + to_string(p[0]) + "," + to_string(p[1]) + ")";
  return text;
}

constexpr int kHalf = 9;     // of the box in the plane
constexpr int kTall = 1000;  // of obstacles, so that no short way leads over them

}  // namespace

void fuzz_visibility(const Case& the_case) {
  Choices& choices = the_case.choices();
  const bool turned = choices.below(2) == 1;
  const AffineMap map = turned ? nef::test::oblique_rotation() : AffineMap::identity();
  const Polygon robot = random_polygon(choices, -1, 1);
  the_case.tell("robot" + text_of(robot));
  planner::Scene scene;
  scene.robot = prism(robot, 0, 1, map);
  std::vector<Polygon> taken;
  for (std::uint32_t i = 1 + choices.below(6); i > 0; --i) {
    const Planar at = random_planar(choices, -4, 4);
    Polygon obstacle = random_polygon(choices, -3, 3);
    for (Planar& p : obstacle) p = {p[0] + at[0], p[1] + at[1]};
    the_case.tell("obstacle" + text_of(obstacle));
    scene.obstacles.push_back(prism(obstacle, -kTall, kTall, map));
    scene.obstacle_names.push_back("obstacle");
    Polygon sums;
    for (const Planar& p : obstacle) {
      for (const Planar& q : robot) sums.push_back({p[0] - q[0], p[1] - q[1]});
    }
    taken.push_back(convex_polygon_of(sums));
  }
  if (!turned) scene.box = {Rational3{-kHalf, -kHalf, 0}, Rational3{kHalf, kHalf, 1}};
  const planner::Problem problem(scene);
  static_cast<void>(the_case.valid(problem.free_space().set(), "the free space"));
  for (int i = 0; i < 3; ++i) {
    const Planar start = random_planar(choices, -kHalf, kHalf);
    const Planar goal = random_planar(choices, -kHalf, kHalf);
    const auto is_taken = [&](const Planar& p) {
      return std::any_of(taken.begin(), taken.end(), [&](const Polygon& polygon) {
        for (std::size_t k = 0; k < polygon.size(); ++k) {
          if (turn_of(polygon[k], polygon[(k + 1) % polygon.size()], p) <= 0) return false;
        }
        return true;
      });
    };
    const std::string question = "from" + text_of({start}) + " to" + text_of({goal}) + (turned ? ", turned" : "");
    planner::PathOptions options;
    const planner::Answer answer = problem.solve(map({start[0], start[1], 0}), map({goal[0], goal[1], 0}), options);
    const auto status = answer.status;
    Case::require((status == planner::Answer::Status::kInvalidStart) == is_taken(start),
                  "start: of the way " + question);
    if (is_taken(start)) continue;
    Case::require((status == planner::Answer::Status::kInvalidGoal) == is_taken(goal), "goal: of the way " + question);
    if (is_taken(goal)) continue;
    const double least = shortest(taken, start, goal, turned ? kTall : kHalf);
    if (turned && std::isinf(least)) continue;  // over the top
    Case::require((status == planner::Answer::Status::kPath) == std::isfinite(least), "reachable: " + question);
    if (!answer.path) {
      the_case.count("proofs");
      continue;
    }
    const double length = answer.path->length;
    Case::require(length >= least * (1 - 1e-9), "length: " + std::to_string(length) + " for the way " + question +
                                                    ", which is at least " + std::to_string(least));
    the_case.count(length < least * 1.0001 ? "shortest paths"
                   : length < least * 1.1  ? "paths up to 10 % longer"
                                           : "longer paths");
  }
}

}  // namespace nef::fuzz

// SPDX-License-Identifier: Apache-2.0
//
// Robots and obstacles that are solids by construction, a union of convex pieces each: bumpy balls, hulls of a few
// points, a box with a window. A path of the interior answer is swept piece by piece; whether there must be one is what
// the complete way says about T and J.
#include "apps/planner/path/partial_answer.h"

#include <algorithm>

#include "apps/planner/path/question.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/mesh/mesh.h"

namespace nef::fuzz {
namespace {

using Points = std::vector<Rational3>;

std::string text_of(const Rational3& p) {
  return "(" + to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]) + ")";
}

// A solid, and the corners of convex pieces whose union it is.
struct MeshSolid {
  Polyhedron set;
  std::vector<Points> pieces;
};

Rational3 random_corner(Choices& choices, int half) {
  return {Rational(choices.between(-half, half)), Rational(choices.between(-half, half)),
          Rational(choices.between(-half, half))};
}

// The union of a few hulls.
MeshSolid random_hulls(Choices& choices, std::uint32_t most, int half) {
  MeshSolid solid;
  for (std::uint32_t i = 1 + choices.below(most); i > 0; --i) {
    const Rational3 at = random_corner(choices, half);
    Points points{at, plus(at, {1, 0, 0}), plus(at, {0, 1, 0}), plus(at, {0, 0, 1})};
    for (std::uint32_t k = choices.below(4); k > 0; --k) points.push_back(plus(at, random_corner(choices, half)));
    solid.set = unite(solid.set, convex_hull(points));
    solid.pieces.push_back(std::move(points));
  }
  return solid;
}

// An octahedron whose faces are cut into n^2 triangles, each corner moved along its ray from the middle: what it bounds
// is the union of the tetrahedra over its triangles.
MeshSolid bumpy_ball(Choices& choices, int n, const Rational3& middle) {
  const int low = choices.between(2, 5);
  const int rough = choices.between(0, 2);
  Mesh mesh;
  const auto corner = [&](const std::array<int, 3>& at) {
    Rational factor(low * 4 + choices.between(0, 2 * rough), 4 * n);
    factor.canonicalize();
    mesh.vertices.push_back(plus(middle, {at[0] * factor, at[1] * factor, at[2] * factor}));
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  };
  std::vector<std::pair<std::array<int, 3>, std::uint32_t>> corners;
  for (int x = -n; x <= n; ++x) {
    for (int y = -n + std::abs(x); y <= n - std::abs(x); ++y) {
      const int z = n - std::abs(x) - std::abs(y);
      corners.push_back({{x, y, z}, corner({x, y, z})});
      if (z != 0) corners.push_back({{x, y, -z}, corner({x, y, -z})});
    }
  }
  const auto index = [&](const std::array<int, 3>& at) {
    return std::find_if(corners.begin(), corners.end(), [&](const auto& c) { return c.first == at; })->second;
  };
  MeshSolid solid;
  const auto triangle = [&](const std::array<std::array<int, 3>, 3>& at, bool turned) {
    std::array<std::uint32_t, 3> face{index(at[0]), index(at[1]), index(at[2])};
    if (turned) std::swap(face[1], face[2]);
    mesh.push_face(face);
    solid.pieces.push_back({middle, mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]});
  };
  for (const int sx : {1, -1}) {
    for (const int sy : {1, -1}) {
      for (const int sz : {1, -1}) {
        const auto at = [&](int i, int j) { return std::array<int, 3>{sx * i, sy * j, sz * (n - i - j)}; };
        const bool turned = sx * sy * sz < 0;
        for (int i = 0; i < n; ++i) {
          for (int j = 0; i + j < n; ++j) {
            triangle({at(i, j), at(i + 1, j), at(i, j + 1)}, turned);
            if (i + j + 1 < n) triangle({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, turned);
          }
        }
      }
    }
  }
  solid.set = from_mesh(mesh);
  return solid;
}

// A hollow box around the origin with a window in one wall.
MeshSolid box_with_window(Choices& choices, int half) {
  const Rational low = Rational(choices.between(-2, 1));
  const Rational width(choices.between(2, 12), 4);
  const Rational height(choices.between(2, 12), 4);
  const auto add = [](MeshSolid& solid, const Rational3& a, const Rational3& b) {
    Points points;
    for (const int corner : {0, 1, 2, 3, 4, 5, 6, 7}) {
      Rational3 p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = (corner >> i & 1) != 0 ? b[i] : a[i];
      points.push_back(p);
    }
    solid.set = unite(solid.set, make_box(a, b));
    solid.pieces.push_back(std::move(points));
  };
  const Rational in = half;
  const Rational out = half + 1;
  MeshSolid solid;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const int side : {-1, 1}) {
      Rational3 a{-out, -out, -out};
      Rational3 b{out, out, out};
      (side < 0 ? b : a)[i] = side * in;
      if (i != 0 || side < 0) {
        add(solid, a, b);
        continue;
      }
      // The wall x = half: below, above, before and behind the window.
      add(solid, a, {b[0], b[1], low});
      add(solid, {a[0], a[1], low + height}, b);
      add(solid, {a[0], a[1], low}, {b[0], low, low + height});
      add(solid, {a[0], low + width, low}, {b[0], b[1], low + height});
    }
  }
  return solid;
}

// True if some piece of the robot that moves from one position to another meets some piece of an obstacle with its
// inside.
bool collides(const MeshSolid& robot, const MeshSolid& obstacle, const Rational3& from, const Rational3& to) {
  for (const Points& piece : robot.pieces) {
    Points swept;
    for (const Rational3& p : piece) {
      swept.push_back(plus(p, from));
      swept.push_back(plus(p, to));
    }
    const auto apart = [&](const Points& other) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto less = [i](const Rational3& a, const Rational3& b) { return a[i] < b[i]; };
        const auto [low, high] = std::minmax_element(swept.begin(), swept.end(), less);
        const auto [least, most] = std::minmax_element(other.begin(), other.end(), less);
        if ((*high)[i] <= (*least)[i] || (*most)[i] <= (*low)[i]) return true;
      }
      return false;
    };
    std::optional<Polyhedron> inside;
    for (const Points& other : obstacle.pieces) {
      if (apart(other)) continue;
      if (!inside) inside = interior(convex_hull(swept));
      if (!intersect(*inside, interior(convex_hull(other))).is_empty()) return true;
    }
  }
  return false;
}

class WideCase {
 public:
  explicit WideCase(const Case& the_case) : case_(the_case), choices_(the_case.choices()) {}

  void run() {
    make_scene();
    const planner::Problem problem(scene_);
    for (int i = 0; i < 3; ++i) {
      scene_.start = random_corner(choices_, in_a_box_ ? 2 : kHalf);
      scene_.goal = random_corner(choices_, kHalf);
      ask(problem);
    }
  }

 private:
  static constexpr int kHalf = 8;

  void make_scene() {
    robot_ = choices_.one_in(4) ? bumpy_ball(choices_, 2, {}) : random_hulls(choices_, 2, 1);
    in_a_box_ = choices_.below(2) == 1;
    if (in_a_box_) obstacles_.push_back(box_with_window(choices_, 4));
    if (choices_.below(in_a_box_ ? 4 : 2) == 0)
      obstacles_.push_back(bumpy_ball(choices_, 3 + choices_.below(2), random_corner(choices_, 3)));
    for (std::uint32_t i = choices_.below(4); i > 0; --i) {
      MeshSolid solid = random_hulls(choices_, 2, 2);
      const Rational3 at = random_corner(choices_, 4);
      solid.set = transform(solid.set, AffineMap::translate(at));
      for (Points& piece : solid.pieces) {
        for (Rational3& p : piece) p = plus(p, at);
      }
      obstacles_.push_back(std::move(solid));
    }
    scene_.robot = robot_.set;
    case_.tell("robot of " + std::to_string(robot_.pieces.size()) + " pieces");
    for (const MeshSolid& obstacle : obstacles_) {
      case_.tell("obstacle of " + std::to_string(obstacle.pieces.size()) + " pieces");
      scene_.obstacles.push_back(obstacle.set);
      scene_.obstacle_names.emplace_back("obstacle");
    }
    if (choices_.below(2) == 1) {
      const int half = choices_.between(4, kHalf);
      scene_.box = {Rational3{-half, -half, -half}, Rational3{half, half, half}};
      case_.tell("box " + std::to_string(half));
    }
  }

  void ask(const planner::Problem& problem) {
    const std::string question = "from " + text_of(*scene_.start) + " to " + text_of(*scene_.goal);
    planner::PathOptions options;
    options.thorough = choices_.below(2) == 1;
    const planner::Answer complete = problem.solve(*scene_.start, *scene_.goal, options);
    const std::optional<planner::Answer> part = planner::interior_answer(scene_, options);
    const bool roomy =
        complete.path && complete.thinness && complete.thinness->piece == 3 && complete.thinness->junction == 3;
    Case::require(part.has_value() == roomy, "existence: " + question + ", want " + (roomy ? "a path" : "none"));
    const bool proved = complete.status == planner::Answer::Status::kInfeasible;
    case_.count(roomy ? "paths" : complete.path ? "tight ones" : proved ? "proofs" : "invalid");
    if (!part) return;
    check(part->path->points, question);
    check(complete.path->points, "completely " + question);
  }

  void check(const Points& path, const std::string& question) {
    Case::require(path.front() == *scene_.start && path.back() == *scene_.goal, "ends: " + question);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      for (const MeshSolid& obstacle : obstacles_) {
        Case::require(!collides(robot_, obstacle, path[i], path[i + 1]),
                      "collision: " + question + " between " + text_of(path[i]) + " and " + text_of(path[i + 1]));
      }
      case_.count("segments");
    }
    if (!scene_.box) return;
    for (const Rational3& p : path) {
      for (std::size_t i = 0; i < 3; ++i) {
        Case::require(p[i] >= (*scene_.box)[0][i] && p[i] <= (*scene_.box)[1][i], "box: " + question);
      }
    }
  }

  const Case& case_;
  Choices& choices_;
  MeshSolid robot_;
  std::vector<MeshSolid> obstacles_;
  planner::Scene scene_;
  bool in_a_box_ = false;
};

}  // namespace

void fuzz_wide(const Case& the_case) { WideCase(the_case).run(); }

}  // namespace nef::fuzz

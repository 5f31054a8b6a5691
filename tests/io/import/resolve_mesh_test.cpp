// SPDX-License-Identifier: Apache-2.0
//
// Meshes that cross themselves, against winding numbers that this file finds for itself: the faces of a closed mesh and
// any apex span tetrahedra, and a point is wound around by the sum of the signs of those that hold it. Where components
// are boxes on a grid, cells are filled instead.
#include "nef/import/resolve_mesh.h"
#include "nef/import/generalized_winding.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>
#include <random>
#include <string>
#include <vector>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/geometry/vectors.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/polyhedron.h"
#include "nef/validation/validate.h"

namespace nef {
namespace {

using Random = std::mt19937;

int below(Random& random, int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }

Rational determinant(const Rational3& a, const Rational3& b, const Rational3& c) { return dot(a, cross(b, c)); }

// Six times the volume of a, b, c, d, positive if a, b, c turn counterclockwise as seen from outside, d inside.
Rational volume6(const Rational3& a, const Rational3& b, const Rational3& c, const Rational3& d) {
  return determinant(minus(a, d), minus(b, d), minus(c, d));
}

struct Soup {
  Mesh mesh;
  std::vector<Mesh> parts;

  void add(const Mesh& part) {
    parts.push_back(part);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (std::size_t f = 0; f < part.face_count(); ++f) {
      std::vector<std::uint32_t> face;
      for (const std::uint32_t v : part.face(f)) face.push_back(first + v);
      mesh.push_face(face);
    }
  }
};

Mesh tetrahedron(const std::array<Rational3, 4>& p) {
  Mesh mesh;
  mesh.vertices.assign(p.begin(), p.end());
  for (const std::array<std::uint32_t, 3>& f :
       {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    mesh.push_face(f);
  }
  return mesh;
}

Mesh box(const std::array<int, 3>& low, const std::array<int, 3>& high) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        {(i & 1U) != 0 ? high[0] : low[0], (i & 2U) != 0 ? high[1] : low[1], (i & 4U) != 0 ? high[2] : low[2]});
  }
  for (const std::array<std::uint32_t, 4>& f : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                                                {4, 5, 7, 6},
                                                {0, 1, 5, 4},
                                                {2, 6, 7, 3},
                                                {0, 4, 6, 2},
                                                {1, 3, 7, 5}}) {
    mesh.push_face(f);
  }
  return mesh;
}

Mesh turned_over(const Mesh& mesh) {
  Mesh result;
  result.vertices = mesh.vertices;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<std::uint32_t> face(mesh.face(f).begin(), mesh.face(f).end());
    std::reverse(face.begin(), face.end());
    result.push_face(face);
  }
  return result;
}

// A triangle, forth and back.
Mesh slit(const std::array<Rational3, 4>& p) {
  Mesh mesh;
  mesh.vertices.assign(p.begin(), p.begin() + 3);
  mesh.push_face(std::array<std::uint32_t, 3>{0, 1, 2});
  mesh.push_face(std::array<std::uint32_t, 3>{2, 1, 0});
  return mesh;
}

std::array<Rational3, 4> corners(Random& random, int size, int denominator) {
  std::array<Rational3, 4> result;
  for (Rational3& p : result) {
    for (Rational& x : p) x = Rational(below(random, size * denominator + 1), denominator);
    for (Rational& x : p) x.canonicalize();
  }
  return result;
}

bool is_flat(const std::array<Rational3, 4>& p) { return volume6(p[0], p[1], p[2], p[3]) == 0; }

bool has_area(const std::array<Rational3, 4>& p) {
  return cross(minus(p[1], p[0]), minus(p[2], p[0])) != Rational3{0, 0, 0};
}

// Flips, doubles, slits, folds (tetrahedra without volume) and copies with common corners, on a grid.
Soup random_soup(Random& random) {
  Soup soup;
  const int size = 4;
  const int denominator = below(random, 3) == 0 ? 7 : 1;
  const int count = 2 + below(random, 5);
  for (int i = 0; i < count; ++i) {
    Mesh part;
    const int kind = below(random, 8);
    std::array<Rational3, 4> p = corners(random, size, denominator);
    if (kind == 0) {
      while (!has_area(p)) p = corners(random, size, denominator);
      part = slit(p);
    } else if (kind == 1) {
      while (!has_area(p) || !is_flat(p)) {
        p = corners(random, 2, 1);
      }
      part = tetrahedron(p);
    } else if (kind < 5) {
      while (is_flat(p)) p = corners(random, size, denominator);
      if (volume6(p[0], p[2], p[1], p[3]) < 0) std::swap(p[0], p[1]);
      part = tetrahedron(p);
    } else if (kind < 7 || soup.parts.empty()) {
      std::array<int, 3> low{};
      std::array<int, 3> high{};
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = below(random, size);
        high[k] = low[k] + 1 + below(random, size - low[k]);
      }
      part = box(low, high);
    } else {
      part = soup.parts[static_cast<std::size_t>(below(random, static_cast<int>(soup.parts.size())))];
    }
    soup.add(below(random, 4) == 0 ? turned_over(part) : part);
  }
  return soup;
}

template <typename Visit>
void for_each_triangle(const Mesh& mesh, Visit visit) {
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      visit(mesh.vertices[face[0]], mesh.vertices[face[i]], mesh.vertices[face[i + 1]]);
    }
  }
}

Rational volume_of_faces(const Mesh& mesh) {
  Rational sum = 0;
  for_each_triangle(mesh,
                    [&](const Rational3& a, const Rational3& b, const Rational3& c) { sum += determinant(a, b, c); });
  return sum / 6;
}

// With an apex and a point that lie on no plane of three vertices.
int winding(const Mesh& mesh, const Rational3& apex, const Rational3& p) {
  int sum = 0;
  for_each_triangle(mesh, [&](const Rational3& a, const Rational3& b, const Rational3& c) {
    const int sign = sgn(volume6(a, b, c, apex));
    const bool inside = sgn(volume6(a, b, c, p)) == sign && sgn(volume6(b, a, apex, p)) == sign &&
                        sgn(volume6(c, b, apex, p)) == sign && sgn(volume6(a, c, apex, p)) == sign;
    if (inside) sum += sign;
  });
  return sum;
}

Rational3 generic_point(Random& random, int size) {
  Rational3 p;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::array<int, 3> primes{1000003, 998244353, 104729};
    p[i] = Rational(static_cast<int>(random() % 1000000007U), primes[i]);
    p[i] = size * p[i] / (Rational(1000000007, primes[i]));
  }
  return p;
}

bool takes(Crossings rule, int w) {
  return rule == Crossings::kUnion ? w > 0 : rule == Crossings::kOdd ? w % 2 != 0 : w != 0;
}

}  // namespace

TEST_CASE("Random soups become what their winding numbers say", "[crossings]") {
  Random random(36);
  int solids = 0;
  int nothing = 0;
  std::map<int, int> seen;
  for (int round = 0; round < 400; ++round) {
    const Soup soup = random_soup(random);
    const Rational total = volume_of_faces(soup.mesh);
    const int turn = total < 0 ? -1 : 1;
    const Rational3 apex = generic_point(random, 9);
    std::vector<Rational3> points;
    std::vector<int> windings;
    for (int i = 0; i < 40; ++i) {
      points.push_back(generic_point(random, 4));
      windings.push_back(turn * winding(soup.mesh, apex, points.back()));
      ++seen[windings.back()];
    }
    for (const Crossings rule : {Crossings::kUnion, Crossings::kNonzero, Crossings::kOdd}) {
      INFO("round " << round << ", " << name(rule));
      const MeshOptions options{.crossings = rule,
                                .monitor = Monitor().on_threads(1U + static_cast<unsigned>(round % 2))};
      Polyhedron set;
      try {
        set = from_mesh(soup.mesh, options);
        ++solids;
      } catch (const InputError& error) {
        INFO(error.what());
        CHECK(std::string(error.what()).find("enclose nothing") != std::string::npos);
        CHECK(std::none_of(windings.begin(), windings.end(), [&](int w) { return takes(rule, w); }));
        ++nothing;
        continue;
      }
      CHECK(validate(set.complex()).empty());
      CHECK(set.is_regular());
      for (std::size_t i = 0; i < points.size(); ++i) CHECK(contains(set, points[i]) == takes(rule, windings[i]));
      const ResolvedMesh resolved = resolve_mesh(soup.mesh, options);
      CHECK(equal(resolved.set, set));
      Rational sum = 0;
      Rational taken = 0;
      for (const auto& [w, entry] : resolved.volumes) {
        sum += w * entry.volume;
        if (takes(rule, w)) taken += entry.volume;
      }
      CHECK(volume(set) == taken);
      if (rule != Crossings::kOdd) {
        CHECK(sum == turn * total);
        CHECK(resolved.inside_out == (turn < 0));
      }
    }
  }
  CHECK(solids > 800);
  CHECK(nothing > 10);
  for (const int w : {-2, -1, 0, 1, 2, 3}) CHECK(seen[w] > 5);
}

TEST_CASE("A soup of solids is their union", "[crossings]") {
  Random random(7);
  for (int round = 0; round < 60; ++round) {
    Soup soup;
    std::vector<Polyhedron> sets;
    const int count = 2 + below(random, 8);
    while (static_cast<int>(sets.size()) < count) {
      std::array<Rational3, 4> p = corners(random, 6, 1 + 2 * below(random, 3));
      if (is_flat(p)) continue;
      if (volume6(p[0], p[2], p[1], p[3]) < 0) std::swap(p[0], p[1]);
      soup.add(tetrahedron(p));
      sets.push_back(convex_hull(p));
    }
    INFO("round " << round);
    CHECK(equal(from_mesh(soup.mesh, {.crossings = Crossings::kUnion}), regularize(unite_all(sets))));
    CHECK(equal(from_mesh(soup.mesh, {.crossings = Crossings::kNonzero}), regularize(unite_all(sets))));
    Polyhedron odd;
    for (const Polyhedron& set : sets) odd = symmetric_difference(odd, set);
    CHECK(equal(from_mesh(soup.mesh, {.crossings = Crossings::kOdd}), regularize(odd)));
  }
}

namespace {

constexpr int kCells = 5;

// Unit cells that no path from outside reaches without passing a side of a box; sides are noted at the cell above.
class Walls {
 public:
  void add(const std::array<int, 3>& low, const std::array<int, 3>& high) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      for (const int at : {low[axis], high[axis]}) {
        for (int i = low[u]; i < high[u]; ++i) {
          for (int j = low[v]; j < high[v]; ++j) {
            std::array<int, 3> cell{};
            cell[axis] = at;
            cell[u] = i;
            cell[v] = j;
            wall_[{axis, cell}] = true;
          }
        }
      }
    }
  }

  [[nodiscard]] Polyhedron unreached() const {
    std::map<std::array<int, 3>, bool> reached{{{-1, -1, -1}, true}};
    std::queue<std::array<int, 3>> queue;
    queue.push({-1, -1, -1});
    while (!queue.empty()) {
      const std::array<int, 3> cell = queue.front();
      queue.pop();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          std::array<int, 3> next = cell;
          next[axis] += step;
          if (next[axis] < -1 || next[axis] > kCells) continue;
          if (wall_.count({axis, step > 0 ? next : cell}) > 0 || reached[next]) continue;
          reached[next] = true;
          queue.push(next);
        }
      }
    }
    std::vector<Polyhedron> cells;
    for (int x = 0; x < kCells; ++x) {
      for (int y = 0; y < kCells; ++y) {
        for (int z = 0; z < kCells; ++z) {
          if (!reached[{x, y, z}]) cells.push_back(make_box({x, y, z}, {x + 1, y + 1, z + 1}));
        }
      }
    }
    return unite_all(cells);
  }

 private:
  std::map<std::pair<std::size_t, std::array<int, 3>>, bool> wall_;
};

}  // namespace

TEST_CASE("What cannot be reached from outside is inside, however faces are turned", "[crossings]") {
  Random random(5);
  for (int round = 0; round < 150; ++round) {
    Mesh mesh;
    Walls walls;
    const int count = 1 + below(random, 4);
    for (int i = 0; i < count; ++i) {
      std::array<int, 3> low{};
      std::array<int, 3> high{};
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = below(random, kCells);
        high[k] = low[k] + 1 + below(random, kCells - low[k]);
      }
      walls.add(low, high);
      const Mesh part = box(low, high);
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
      for (std::size_t f = 0; f < part.face_count(); ++f) {
        std::vector<std::uint32_t> face;
        for (const std::uint32_t v : part.face(f)) face.push_back(first + v);
        if (below(random, 2) == 0) std::reverse(face.begin(), face.end());
        mesh.push_face(face);
      }
    }
    INFO("round " << round);
    const Polyhedron set = from_mesh(mesh, {.crossings = Crossings::kOutside});
    CHECK(validate(set.complex()).empty());
    CHECK(equal(set, walls.unreached()));
  }
}

TEST_CASE("Rules say what they do, and refusals which rule to take", "[crossings]") {
  Soup soup;
  soup.add(box({0, 0, 0}, {2, 2, 2}));
  soup.add(box({1, 1, 1}, {3, 3, 3}));
  CHECK_THROWS_WITH(
      from_mesh(soup.mesh),
      Catch::Contains("6 pairs of faces cross; crossings=\"union\" selects points that are enclosed at least once"));
  Messages notes;
  const Polyhedron both = from_mesh(soup.mesh, {.crossings = Crossings::kUnion}, &notes);
  CHECK(volume(both) == 15);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == "6 pairs of faces cross; selected points that are enclosed at least once");
  CHECK(volume(from_mesh(soup.mesh, {.crossings = Crossings::kOdd})) == 14);

  // One in the other, without contact.
  Soup nested;
  nested.add(box({0, 0, 0}, {4, 4, 4}));
  nested.add(box({1, 1, 1}, {2, 2, 2}));
  CHECK_THROWS_WITH(from_mesh(nested.mesh), Catch::Contains("crossings=\"union\""));
  notes.clear();
  CHECK(equal(from_mesh(nested.mesh, {.crossings = Crossings::kUnion}, &notes), make_box({0, 0, 0}, {4, 4, 4})));
  REQUIRE(notes.size() == 1);
  CHECK(
      notes[0] ==
      "the mesh encloses parts of space several times or inside out; selected points that are enclosed at least once");

  // A clean mesh is none of their business.
  notes.clear();
  for (const Crossings rule : kAllCrossings) {
    CHECK(crossings_of_name(name(rule)) == rule);
    CHECK(equal(from_mesh(box({0, 0, 0}, {1, 1, 1}), {.crossings = rule}, &notes), make_box({0, 0, 0}, {1, 1, 1})));
  }
  CHECK(notes.empty());
  CHECK_FALSE(crossings_of_name("both").has_value());

  // An open mesh encloses nothing by any rule.
  Mesh open = box({0, 0, 0}, {1, 1, 1});
  open.face_begin.pop_back();
  open.corners.resize(open.face_begin.back());
  for (const Crossings rule : kAllCrossings) CHECK_THROWS_AS(from_mesh(open, {.crossings = rule}), InputError);
  CHECK_THROWS_WITH(from_mesh(open), !Catch::Contains("crossings"));
}

namespace {

// A square across an axis, seen counterclockwise from the side of `sign`, of half-side 2 about the point `at` of the
// axis.
void add_square(Soup& soup, std::size_t axis, int at, int sign, int half = 2) {
  Mesh square;
  constexpr std::array<std::array<int, 2>, 4> kCorners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (const auto& corner : kCorners) {
    Rational3 p;
    p[axis] = at;
    p[(axis + 1) % 3] = half * corner[0];
    p[(axis + 2) % 3] = half * corner[1];
    square.vertices.push_back(p);
  }
  square.push_face(sign > 0 ? std::array<std::uint32_t, 4>{0, 1, 2, 3} : std::array<std::uint32_t, 4>{3, 2, 1, 0});
  soup.add(square);
}

}  // namespace

TEST_CASE("Winding numbers of open surfaces are solid angles", "[crossings][guess]") {
  // A square of side s at distance d is seen under the angle 4 atan(s^2 / (2 d sqrt(4 d^2 + 2 s^2))).
  for (const double d : {0.125, 1.0, 3.0, 100.0}) {
    Soup soup;
    add_square(soup, 1, 0, 1, 1);
    const MeshSurface surface(soup.mesh, {});
    const double angle = 4 * std::atan(4 / (2 * d * std::sqrt(4 * d * d + 8)));
    const GeneralizedWinding winding(soup.mesh, surface.triangles);
    const double full = 4 * std::acos(-1.0);
    CHECK(winding.around({0, -Rational(d), 0}) == Approx(angle / full));
    CHECK(winding.around({0, Rational(d), 0}) == Approx(-angle / full));
  }
  const Mesh closed = box({0, 0, 0}, {1, 2, 3});
  const MeshSurface surface(closed, {});
  const GeneralizedWinding winding(closed, surface.triangles);
  CHECK(winding.around({Rational(1, 7), Rational(9, 5), 1}) == Approx(1));
  CHECK(winding.around({Rational(8, 7), Rational(9, 5), 1}) == Approx(0).margin(1e-12));
}

TEST_CASE("A soup of open sheets is guessed by how its faces wind, and that is told", "[crossings][guess]") {
  // Six squares that stick out beyond a cube, and a lid over one of the shafts beside it, turned towards the cube.
  Soup soup;
  for (const std::size_t axis : {0U, 1U, 2U}) {
    for (const int sign : {-1, 1}) add_square(soup, axis, sign, sign);
  }
  add_square(soup, 0, 2, -1, 3);
  CHECK_THROWS_AS(from_mesh(soup.mesh, {.crossings = Crossings::kUnion}), InputError);
  Messages notes;
  const Polyhedron guessed = from_mesh(soup.mesh, {.crossings = Crossings::kGuess}, &notes);
  CHECK(equal(guessed, make_box({-1, -1, -1}, {1, 1, 1})));
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("points with a winding number of at least one half (a guess)") != std::string::npos);
  // All that is enclosed has the shaft, too.
  CHECK(equal(from_mesh(soup.mesh, {.crossings = Crossings::kOutside}), make_box({-1, -1, -1}, {2, 1, 1})));
  // One square that is turned wrongly is outvoted.
  Soup turned;
  for (const std::size_t axis : {0U, 1U, 2U}) {
    for (const int sign : {-1, 1}) add_square(turned, axis, sign, axis == 2 ? 1 : sign);
  }
  CHECK(equal(from_mesh(turned.mesh, {.crossings = Crossings::kGuess}), make_box({-1, -1, -1}, {1, 1, 1})));
  // A closed mesh is what union makes of it.
  Soup overlapping;
  overlapping.add(box({0, 0, 0}, {2, 2, 2}));
  overlapping.add(box({1, 1, 1}, {3, 3, 3}));
  CHECK(equal(from_mesh(overlapping.mesh, {.crossings = Crossings::kGuess}),
              from_mesh(overlapping.mesh, {.crossings = Crossings::kUnion})));
}

TEST_CASE("A polygon that crosses itself is taken as a cycle", "[crossings]") {
  // A prism over a bow-tie, whose halves are turned differently: 1 around one, -1 around the other.
  Mesh mesh;
  for (const int z : {0, 1}) {
    for (const auto& [x, y] : {std::pair(0, 0), {4, 4}, {4, 0}, {0, 2}}) mesh.vertices.push_back({x, y, z});
  }
  mesh.push_face(std::array<std::uint32_t, 4>{0, 1, 2, 3});
  mesh.push_face(std::array<std::uint32_t, 4>{7, 6, 5, 4});
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    mesh.push_face(std::array<std::uint32_t, 4>{i, 4 + i, 4 + j, j});
  }
  CHECK_THROWS_AS(from_mesh(mesh), InputError);
  // The diagonals y = x and y = 2 - x / 2 meet in (4/3, 4/3): triangles of 4/3 and 16/3.
  const ResolvedMesh resolved = resolve_mesh(mesh, {.crossings = Crossings::kNonzero});
  CHECK(resolved.volumes.at(1).volume == Rational(16, 3));
  CHECK(resolved.volumes.at(-1).volume == Rational(4, 3));
  CHECK(volume(resolved.set) == Rational(20, 3));
  CHECK(volume(from_mesh(mesh, {.crossings = Crossings::kUnion})) == Rational(16, 3));
}

TEST_CASE("Faces in one plane may be turned differently where they meet", "[crossings]") {
  // Two slits that share an edge, each drawn from the other side first.
  Soup soup;
  const Rational3 a{0, 0, 1};
  const Rational3 b{1, 1, 0};
  soup.add(slit({a, b, Rational3{1, 1, 1}, {}}));
  soup.add(slit({b, a, Rational3{0, 0, 0}, {}}));
  CHECK_THROWS_WITH(from_mesh(soup.mesh, {.crossings = Crossings::kUnion}), Catch::Contains("enclose nothing"));
  Soup turned;
  turned.add(slit({a, b, Rational3{1, 1, 1}, {}}));
  turned.add(turned_over(slit({b, a, Rational3{0, 0, 0}, {}})));
  turned.add(box({0, 0, 0}, {1, 2, 1}));
  for (const Crossings rule : {Crossings::kUnion, Crossings::kOdd}) {
    const Polyhedron set = from_mesh(turned.mesh, {.crossings = rule});
    CHECK(equal(set, make_box({0, 0, 0}, {1, 2, 1})));
  }
}

}  // namespace nef

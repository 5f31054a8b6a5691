// SPDX-License-Identifier: Apache-2.0
//
// One rule for the components of a mesh, with contact and without: they wind around every point once or not at all.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/mesh/mesh_check.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/nested_components.h"
#include "nef/polyhedron.h"
#include "nef/validation/validate.h"

namespace nef {
namespace {

using Low = std::array<int, 3>;

struct Brick {
  Low low{};
  Low high{};
  bool inward = false;
};

void add(Mesh& mesh, const Brick& b) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices.push_back({(i & 1U) != 0 ? b.high[0] : b.low[0], (i & 2U) != 0 ? b.high[1] : b.low[1],
                             (i & 4U) != 0 ? b.high[2] : b.low[2]});
  }
  const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    std::array<std::uint32_t, 4> face{first + q[0], first + q[1], first + q[2], first + q[3]};
    if (b.inward) std::swap(face[1], face[3]);
    mesh.push_face(face);
  }
}

Mesh mesh_of(const std::vector<Brick>& bricks) {
  Mesh mesh;
  for (const Brick& b : bricks) add(mesh, b);
  return mesh;
}

// Tetrahedra with outward faces.
void add_tetrahedron(Mesh& mesh, const std::array<Rational3, 4>& p, bool inward = false) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), p.begin(), p.end());
  const Rational volume = [&] {
    std::array<Rational3, 3> e;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) e[i][k] = p[i + 1][k] - p[0][k];
    }
    return Rational(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
                    e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
                    e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]));
  }();
  for (std::array<std::uint32_t, 3> f : {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    if ((volume < 0) != inward) std::swap(f[1], f[2]);
    for (std::uint32_t& v : f) v += first;
    mesh.push_face(f);
  }
}

std::string refusal(const Mesh& mesh, const MeshOptions& options = {}) {
  try {
    from_mesh(mesh, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

constexpr int kSize = 5;

int index(int x, int y, int z) { return (x * kSize + y) * kSize + z; }

std::vector<int> windings(const std::vector<Brick>& bricks) {
  std::vector<int> winding(kSize * kSize * kSize, 0);
  for (const Brick& b : bricks) {
    for (int x = b.low[0]; x < b.high[0]; ++x) {
      for (int y = b.low[1]; y < b.high[1]; ++y) {
        for (int z = b.low[2]; z < b.high[2]; ++z) {
          winding[static_cast<std::size_t>(index(x, y, z))] += b.inward ? -1 : 1;
        }
      }
    }
  }
  return winding;
}

// Nothing if the mesh must be refused.
std::optional<Polyhedron> cells_wound_once(const std::vector<Brick>& bricks) {
  const std::vector<int> winding = windings(bricks);
  const auto [low, high] = std::minmax_element(winding.begin(), winding.end());
  if (*high - *low != 1) return std::nullopt;
  std::vector<Polyhedron> cells;
  for (int x = 0; x < kSize; ++x) {
    for (int y = 0; y < kSize; ++y) {
      for (int z = 0; z < kSize; ++z) {
        if (winding[static_cast<std::size_t>(index(x, y, z))] == 0) continue;
        cells.push_back(make_box({x, y, z}, {x + 1, y + 1, z + 1}));
      }
    }
  }
  return unite_all(cells);
}

// True if there is a sheet of faces that undo each other: then faces may cross it, which is refused, without a
// winding number that shows it.
bool may_cancel(const std::vector<Brick>& bricks) {
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const auto& [p, q, back] :
             {std::tuple(bricks[i].low[axis], bricks[j].low[axis], bricks[i].inward != bricks[j].inward),
              std::tuple(bricks[i].high[axis], bricks[j].high[axis], bricks[i].inward != bricks[j].inward),
              std::tuple(bricks[i].low[axis], bricks[j].high[axis], bricks[i].inward == bricks[j].inward),
              std::tuple(bricks[i].high[axis], bricks[j].low[axis], bricks[i].inward == bricks[j].inward)}) {
          if (p != q || !back) continue;
          const std::size_t u = (axis + 1) % 3;
          const std::size_t v = (axis + 2) % 3;
          if (bricks[i].low[u] < bricks[j].high[u] && bricks[j].low[u] < bricks[i].high[u] &&
              bricks[i].low[v] < bricks[j].high[v] && bricks[j].low[v] < bricks[i].high[v]) {
            return true;
          }
        }
      }
    }
  }
  return false;
}

bool holds(const Brick& outer, const Brick& inner) {
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    inside = inside && outer.low[i] < inner.low[i] && inner.high[i] < outer.high[i];
  }
  return inside;
}

bool cross_nowhere(const Brick& a, const Brick& b) {
  bool apart = false;
  for (std::size_t i = 0; i < 3; ++i) apart = apart || a.high[i] < b.low[i] || b.high[i] < a.low[i];
  return apart || holds(a, b) || holds(b, a);
}

}  // namespace

TEST_CASE("Random bricks are taken iff they wind around every cell once or not at all", "[winding]") {
  std::mt19937 random(11);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int taken = 0;
  int refused = 0;
  int touching = 0;
  for (int round = 0; round < 1500; ++round) {
    std::vector<Brick> bricks(static_cast<std::size_t>(2 + below(3)));
    for (Brick& b : bricks) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        b.low[axis] = below(kSize);
        b.high[axis] = b.low[axis] + 1 + below(kSize - b.low[axis]);
      }
      b.inward = below(3) == 0;
    }
    const Mesh mesh = mesh_of(bricks);
    const std::optional<Polyhedron> wanted = cells_wound_once(bricks);
    INFO("round " << round);
    if (!wanted) {
      CHECK(!refusal(mesh).empty());
      ++refused;
      continue;
    }
    const std::string why = refusal(mesh);
    if (!why.empty() && may_cancel(bricks) && why.find("cross each other") != std::string::npos) continue;
    INFO(why);
    REQUIRE(why.empty());
    const Polyhedron made = from_mesh(mesh);
    CHECK(validate(made.complex()).empty());
    CHECK(equal(made, *wanted));
    for (const MeshProblem& problem : check_mesh(mesh)) {
      INFO(problem.text);
      CHECK(problem.legal);
    }
    ++taken;
    touching += may_cancel(bricks) ? 1 : 0;
  }
  CHECK(taken > 100);
  CHECK(touching > 10);
  CHECK(refused > 100);
}

// Coordinates with many digits: products of them are no small numbers.
TEST_CASE("Random bricks in an oblique position", "[winding]") {
  AffineMap map = AffineMap::identity();
  map.linear = {{{Rational("123456789/1000003"), Rational(-7, 3), 1},
                 {Rational(2, 7), Rational("987654321/10007"), Rational(-5, 11)},
                 {Rational("1000000007/13"), Rational(1, 3), Rational("55555555/17")}}};
  std::mt19937 random(12);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int taken = 0;
  for (int round = 0; round < 600; ++round) {
    std::vector<Brick> bricks(2);
    for (Brick& b : bricks) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        b.low[axis] = below(3);
        b.high[axis] = b.low[axis] + 1 + below(2);
      }
    }
    const std::optional<Polyhedron> wanted = cells_wound_once(bricks);
    Mesh mesh = mesh_of(bricks);
    for (Rational3& p : mesh.vertices) p = map(p);
    INFO("round " << round << ": " << refusal(mesh));
    REQUIRE(refusal(mesh).empty() == wanted.has_value());
    if (!wanted || !may_cancel(bricks)) continue;
    CHECK(equal(from_mesh(mesh), transform(*wanted, map)));
    ++taken;
  }
  CHECK(taken > 20);
}

TEST_CASE("A component inside another and turned like it is refused, with contact and without", "[winding]") {
  for (const bool outward : {true, false}) {
    for (const Rational& raise : {Rational(0), Rational(1, 10)}) {
      Mesh mesh = mesh_of({{{0, 0, 0}, {4, 4, 4}, false}});
      // Its apex on the floor, inside a face.
      add_tetrahedron(
          mesh,
          {Rational3{2, 2, raise}, Rational3{1, 1, 1 + raise}, Rational3{3, 1, 1 + raise}, Rational3{2, 3, 1 + raise}},
          !outward);
      INFO(outward << " " << raise);
      if (outward) {
        CHECK(refusal(mesh).find("contradict each other") != std::string::npos);
      } else {
        const Polyhedron solid = from_mesh(mesh);
        CHECK(validate(solid.complex()).empty());
        CHECK(volume(solid) == Rational(64) - Rational(2, 3));
      }
    }
  }
  // Touching in a corner that both name.
  Mesh corner = mesh_of({{{0, 0, 0}, {4, 4, 4}, false}});
  add_tetrahedron(corner, {Rational3{0, 0, 0}, Rational3{2, 1, 1}, Rational3{1, 2, 1}, Rational3{1, 1, 2}});
  CHECK(refusal(corner).find("contradict each other") != std::string::npos);
}

TEST_CASE("An edge that stands inside a face is no crossing", "[winding]") {
  for (const bool inward : {false, true}) {
    // From inside with the edge on the floor: a cavity if it is turned inward, else a contradiction.
    Mesh mesh = mesh_of({{{0, 0, 0}, {4, 4, 4}, false}});
    add_tetrahedron(mesh, {Rational3{1, 2, 0}, Rational3{3, 2, 0}, Rational3{2, 1, 1}, Rational3{2, 3, 1}}, inward);
    const std::string why = refusal(mesh);
    CHECK(why.find("cross") == std::string::npos);
    CHECK(why.empty() == inward);
    if (inward) CHECK(volume(from_mesh(mesh)) == Rational(64) - Rational(2, 3));
  }
}

TEST_CASE("Boxes glued face to face lose the wall between them", "[winding]") {
  const auto made = [](const std::vector<Brick>& bricks) {
    Messages messages;
    Polyhedron set = from_mesh(mesh_of(bricks), {}, &messages);
    CHECK(validate(set.complex()).empty());
    return set;
  };
  CHECK(equal(made({{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}}), make_box({0, 0, 0}, {2, 1, 1})));
  CHECK(equal(made({{{0, 0, 0}, {2, 2, 2}}, {{2, 1, 1}, {3, 3, 3}}}),
              unite(make_box({0, 0, 0}, {2, 2, 2}), make_box({2, 1, 1}, {3, 3, 3}))));
  // All the other way round.
  CHECK(equal(made({{{0, 0, 0}, {1, 1, 1}, true}, {{1, 0, 0}, {2, 1, 1}, true}}), make_box({0, 0, 0}, {2, 1, 1})));
  // Turned differently.
  CHECK_FALSE(refusal(mesh_of({{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}, true}})).empty());
  // The same box twice.
  CHECK_FALSE(refusal(mesh_of({{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}})).empty());
  CHECK_FALSE(refusal(mesh_of({{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}, true}})).empty());
}

TEST_CASE("A solid that stands twice in a mesh, once inside out, is told to enclose nothing", "[winding]") {
  const auto notes = [](const std::vector<Brick>& bricks, const Polyhedron& expected) {
    Messages messages;
    CHECK(equal(from_mesh(mesh_of(bricks), {.crossings = Crossings::kUnion}, &messages), expected));
    return messages;
  };
  const Brick box{{0, 0, 0}, {4, 4, 4}};
  const Polyhedron set = make_box({0, 0, 0}, {4, 4, 4});
  const Messages told{"12 faces back to back with others left out: they enclose nothing"};
  CHECK(notes({box, {{6, 0, 0}, {7, 1, 1}}, {{6, 0, 0}, {7, 1, 1}, true}}, set) == told);
  // A cavity that another solid fills.
  CHECK(notes({box, {{1, 1, 1}, {2, 2, 2}, true}, {{1, 1, 1}, {2, 2, 2}}}, set) == told);
  // Nothing is said of a double one that shares an edge with the box, and so is a part of what encloses something.
  CHECK(notes({box, {{4, 4, 0}, {5, 5, 4}}, {{4, 4, 0}, {5, 5, 4}, true}}, set).empty());
  CHECK(notes({box, {{4, 4, 4}, {5, 5, 5}}, {{4, 4, 4}, {5, 5, 5}, true}}, set) == told);
  // Walls between solids are nothing to tell, also where a solid has others on all sides.
  std::vector<Brick> block;
  for (int i = 0; i < 27; ++i) {
    const Low low{i % 3, i / 3 % 3, i / 9};
    block.push_back({low, {low[0] + 1, low[1] + 1, low[2] + 1}});
  }
  CHECK(notes(block, make_box({0, 0, 0}, {3, 3, 3})).empty());
}

TEST_CASE("Where faces share vertices, no checks are needed to find what is wrong with it", "[winding]") {
  const Mesh glued = mesh_of({{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}});
  CHECK(equal(from_mesh(glued, {.check = false}), make_box({0, 0, 0}, {2, 1, 1})));
  CHECK_FALSE(refusal(mesh_of({{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}}), {.check = false}).empty());
}

TEST_CASE("Faces without area close a mesh and hold nothing", "[winding]") {
  // A box whose front edge has a vertex in the middle on one side only: a triangle without area lies between.
  const Mesh box = read_off(
      "OFF\n9 13 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n0 0 4\n4 0 4\n4 4 4\n0 4 4\n2 0 4\n"
      "3 0 3 2\n3 0 2 1\n3 0 1 8\n3 0 8 4\n3 1 5 8\n3 4 8 5\n3 4 5 6\n3 4 6 7\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n"
      "4 3 0 4 7\n",
      "box.off");
  Messages messages;
  const Polyhedron solid = from_mesh(box, {}, &messages);
  CHECK(equal(solid, make_box({0, 0, 0}, {4, 4, 4})));
  REQUIRE(messages.size() == 1);
  CHECK(messages[0] == "1 face without area left out");
}

TEST_CASE("A face that comes to a vertex twice is a face with a hole", "[winding]") {
  // A square frame: top and bottom are keyholes.
  const Mesh frame = read_off(
      "OFF\n16 10 0\n0 0 0\n3 0 0\n3 3 0\n0 3 0\n1 1 0\n2 1 0\n2 2 0\n1 2 0\n"
      "0 0 1\n3 0 1\n3 3 1\n0 3 1\n1 1 1\n2 1 1\n2 2 1\n1 2 1\n"
      "10 8 9 10 11 8 12 15 14 13 12\n10 0 4 5 6 7 4 0 3 2 1\n"
      "4 0 1 9 8\n4 1 2 10 9\n4 2 3 11 10\n4 3 0 8 11\n4 5 4 12 13\n4 6 5 13 14\n4 7 6 14 15\n4 4 7 15 12\n",
      "frame.off");
  const Polyhedron solid = from_mesh(frame);
  CHECK(validate(solid.complex()).empty());
  CHECK(equal(solid, regularize(subtract(make_box({0, 0, 0}, {3, 3, 1}), make_box({1, 1, 0}, {2, 2, 1})))));
  for (const MeshProblem& problem : check_mesh(frame)) CHECK(problem.legal);
}

TEST_CASE("A legal finding hides no illegal one of its kind", "[winding]") {
  // Boxes that share an edge, which is legal, and tetrahedra inside one another that share one, which is not.
  Mesh mesh = mesh_of({{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 0}, {2, 2, 1}}});
  add_tetrahedron(mesh, {Rational3{10, 0, 0}, Rational3{10, 0, 4}, Rational3{14, 0, 2}, Rational3{10, 4, 2}});
  add_tetrahedron(mesh, {Rational3{10, 0, 0}, Rational3{10, 0, 4}, Rational3{12, 1, 2}, Rational3{11, 2, 2}});
  bool illegal = false;
  for (const MeshProblem& p : check_mesh(mesh, {.max_per_kind = 1})) illegal = illegal || !p.legal;
  CHECK(illegal);
  CHECK_FALSE(refusal(mesh).empty());
}

TEST_CASE("Bricks beside and in each other are told to be one solid iff they are", "[winding]") {
  std::mt19937 random(5);
  std::size_t yes = 0;
  std::size_t no = 0;
  while (yes < 60 || no < 60) {
    std::vector<Brick> bricks;
    const std::size_t most = 2 + random() % 6;
    for (int tries = 0; tries < 60 && bricks.size() < most; ++tries) {
      Brick brick;
      for (std::size_t i = 0; i < 3; ++i) {
        brick.low[i] = static_cast<int>(random() % 12);
        brick.high[i] = brick.low[i] + 1 + static_cast<int>(random() % 12);
      }
      brick.inward = random() % 3 == 0;
      const auto fits = [&](const Brick& other) { return cross_nowhere(brick, other); };
      if (std::all_of(bricks.begin(), bricks.end(), fits)) bricks.push_back(brick);
    }
    const bool one_solid = std::all_of(bricks.begin(), bricks.end(), [&](const Brick& brick) {
      int winding = 0;
      for (const Brick& other : bricks) winding += holds(other, brick) ? (other.inward ? -1 : 1) : 0;
      return winding == (brick.inward ? 1 : 0);
    });
    ++(one_solid ? yes : no);
    // Turned a little, so that no ray along an axis meets a side.
    Mesh mesh = mesh_of(bricks);
    for (Rational3& p : mesh.vertices) {
      p = {p[0] + p[1] / 1000 + p[2] / 1700, p[1] - p[0] / 1300 + p[2] / 1100, p[2] + p[0] / 900 - p[1] / 1500};
    }
    CHECK(surely_one_solid(MeshSurface(mesh, {}), {}) == one_solid);
    if (one_solid) CHECK(refusal(mesh).empty());
    // As they are, sides may hide one from another.
    if (!one_solid) CHECK_FALSE(surely_one_solid(MeshSurface(mesh_of(bricks), {}), {}));
  }
}

}  // namespace nef

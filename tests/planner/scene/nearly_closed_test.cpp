// SPDX-License-Identifier: Apache-2.0
//
// Meshes that bound no solid by the rules, as models from the web are, and the sets that they mean.
#include "apps/planner/scene/nearly_closed.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "apps/planner/scene/scene.h"
#include "apps/planner/scene/shapes.h"
#include "nef/base/error.h"
#include "tests/planner/command_helpers.h"
#include "tests/support/shapes/fixed_cases.h"

namespace nef::planner::test {
namespace {

using Triangles = std::vector<std::array<Rational3, 3>>;

void add_quad(Triangles& to, const Rational3& a, const Rational3& b, const Rational3& c, const Rational3& d) {
  to.push_back({a, b, c});
  to.push_back({a, c, d});
}

// The surface of a box, outward.
Triangles box(const Rational3& l, const Rational3& h) {
  Triangles result;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    for (const bool top : {false, true}) {
      Rational3 a = l;
      a[i] = top ? h[i] : l[i];
      Rational3 b = a;
      b[j] = h[j];
      Rational3 c = b;
      c[k] = h[k];
      Rational3 d = a;
      d[k] = h[k];
      if (top) {
        add_quad(result, a, b, c, d);
      } else {
        add_quad(result, a, d, c, b);
      }
    }
  }
  return result;
}

void append(Triangles& to, const Triangles& more) { to.insert(to.end(), more.begin(), more.end()); }

// A soup: every triangle has vertices of its own.
Mesh soup(const Triangles& triangles) {
  Mesh mesh;
  for (const auto& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
    mesh.push_face(std::array<std::uint32_t, 3>{first, first + 1, first + 2});
  }
  return mesh;
}

// Doubled, turned at random, and shuffled.
Triangles double_sided(Triangles triangles, unsigned seed) {
  std::mt19937 random(seed);
  append(triangles, triangles);
  std::shuffle(triangles.begin(), triangles.end(), random);
  for (auto& triangle : triangles) {
    if (random() % 2 == 0) std::swap(triangle[1], triangle[2]);
  }
  return triangles;
}

TEST_CASE("double-sided meshes turned at random are the solid inside") {
  for (unsigned seed = 0; seed < nef::test::fewer(5); ++seed) {
    const MeshMeaning one = meaning_of(soup(double_sided(box({0, 0, 0}, {1, 2, 3}), seed)));
    CHECK(equal(one.set, make_box({0, 0, 0}, {1, 2, 3})));
    CHECK(one.duplicate_faces == 12);
    CHECK(one.solid_parts == 1);
    CHECK(one.surface_parts == 0);
    // Two that overlap, and one apart: the union.
    Triangles several = box({0, 0, 0}, {2, 2, 2});
    append(several, box({1, 1, 1}, {3, 3, 3}));
    append(several, box({9, 0, 0}, {10, 1, 1}));
    const Polyhedron boxes[] = {make_box({0, 0, 0}, {2, 2, 2}), make_box({1, 1, 1}, {3, 3, 3}),
                                make_box({9, 0, 0}, {10, 1, 1})};
    CHECK(equal(meaning_of(soup(double_sided(several, seed))).set, unite_all(boxes)));
  }
}

TEST_CASE("a doubled wall has a room in it, and what stands in the room is there") {
  Triangles house = box({0, 0, 0}, {9, 9, 9});
  append(house, box({1, 1, 1}, {8, 8, 8}));
  append(house, box({4, 4, 4}, {5, 5, 5}));
  const Polyhedron wall = subtract(make_box({0, 0, 0}, {9, 9, 9}), interior(make_box({1, 1, 1}, {8, 8, 8})));
  const MeshMeaning meaning = meaning_of(soup(double_sided(house, 1)));
  CHECK(equal(meaning.set, unite(wall, make_box({4, 4, 4}, {5, 5, 5}))));
  CHECK(meaning.solid_parts == 3);
  // A pillar that goes through both walls is one with them.
  append(house, box({4, 4, -1}, {5, 5, 3}));
  CHECK(equal(meaning_of(soup(double_sided(house, 2))).set,
              unite(unite(wall, make_box({4, 4, 4}, {5, 5, 5})), make_box({4, 4, -1}, {5, 5, 3}))));
  // So is a shelf in the room that sticks in its wall.
  Triangles room = box({0, 0, 0}, {9, 9, 9});
  append(room, box({1, 1, 1}, {8, 8, 8}));
  append(room, box({Rational(1, 2), 3, 3}, {4, 5, 4}));
  CHECK(equal(meaning_of(soup(double_sided(room, 3))).set, unite(wall, make_box({Rational(1, 2), 3, 3}, {4, 5, 4}))));
}

TEST_CASE("faces that meet in parts of edges, and slivers between them, close a box all the same") {
  // The top is cut in x = 1/3 and not at the sides: its edges meet others in parts. A flat triangle covers the seam.
  Triangles triangles = box({0, 0, 0}, {1, 1, 1});
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(),
                                 [](const auto& t) { return t[0][2] == 1 && t[1][2] == 1 && t[2][2] == 1; }),
                  triangles.end());
  REQUIRE(triangles.size() == 10);
  const Rational third(1, 3);
  add_quad(triangles, {0, 0, 1}, {third, 0, 1}, {third, 1, 1}, {0, 1, 1});
  add_quad(triangles, {third, 0, 1}, {1, 0, 1}, {1, 1, 1}, {third, 1, 1});
  triangles.push_back({Rational3{0, 0, 1}, Rational3{third, 0, 1}, Rational3{1, 0, 1}});
  const MeshMeaning meaning = meaning_of(soup(triangles));
  CHECK(equal(meaning.set, make_box({0, 0, 0}, {1, 1, 1})));
}

TEST_CASE("fins stay surfaces, open and ambiguous meshes do so as a whole") {
  Triangles fin = box({0, 0, 0}, {2, 2, 2});
  append(fin, {{Rational3{2, 2, 2}, Rational3{2, 2, 0}, Rational3{4, 4, 1}}});
  const MeshMeaning with_fin = meaning_of(soup(double_sided(fin, 3)));
  const Rational3 corners[] = {{2, 2, 2}, {2, 2, 0}, {4, 4, 1}};
  CHECK(equal(with_fin.set, unite(make_box({0, 0, 0}, {2, 2, 2}), convex_hull(corners))));
  CHECK(with_fin.solid_parts == 1);
  CHECK(with_fin.surface_parts == 1);

  Triangles open = box({0, 0, 0}, {2, 2, 2});
  open.pop_back();
  open.pop_back();
  const MeshMeaning surface = meaning_of(soup(open));
  CHECK(volume(surface.set) == Rational(0));
  CHECK(surface.solid_parts == 0);

  Triangles partition = box({0, 0, 0}, {2, 2, 2});
  add_quad(partition, {0, 0, 0}, {2, 2, 0}, {2, 2, 2}, {0, 0, 2});
  const MeshMeaning rooms = meaning_of(soup(double_sided(partition, 4)));
  CHECK(volume(rooms.set) == Rational(0));
  CHECK(rooms.surface_parts == 1);
}

TEST_CASE("a floor and walls that share no vertices close together") {
  Triangles walls = box({0, 0, 0}, {2, 2, 2});
  walls.erase(std::remove_if(walls.begin(), walls.end(),
                             [](const auto& t) { return t[0][2] == 0 && t[1][2] == 0 && t[2][2] == 0; }),
              walls.end());
  add_quad(walls, {-1, -1, 0}, {3, -1, 0}, {3, 3, 0}, {-1, 3, 0});
  const Polyhedron floor = make_box({-1, -1, 0}, {3, 3, 0});
  CHECK(equal(meaning_of(soup(walls)).set, unite(make_box({0, 0, 0}, {2, 2, 2}), floor)));
}

std::string off_of(const Mesh& mesh) {
  std::string text = "OFF\n" + std::to_string(mesh.vertices.size()) + " " + std::to_string(mesh.face_count()) + " 0\n";
  for (const Rational3& v : mesh.vertices) {
    text += to_string(v[0]) + " " + to_string(v[1]) + " " + to_string(v[2]) + "\n";
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    text += "3";
    for (const std::uint32_t v : mesh.face(f)) text += " " + std::to_string(v);
    text += "\n";
  }
  return text;
}

TEST_CASE("scenes say what a mesh was taken for") {
  const Folder folder;
  const Mesh mesh = soup(double_sided(box({0, 0, 0}, {1, 1, 1}), 7));
  const std::string file = folder.write("twice.off", off_of(mesh));
  Messages messages;
  CHECK(equal(read_shape_file(file, scene_meshes(), &messages), make_box({0, 0, 0}, {1, 1, 1})));
  REQUIRE(messages.size() == 1);
  CHECK_THAT(messages[0], Catch::Contains("12 faces occur twice"));
  CHECK_THAT(messages[0], Catch::Contains("1 solid part "));
  Mesh bad = mesh;
  bad.corners[0] = 1000;
  CHECK_THROWS_AS(meaning_of(bad), InputError);
  CHECK_THROWS_AS(read_shape_file(file, {.crossings = Crossings::kRefuse}, &messages), InputError);
}

TEST_CASE("scenes take meshes that cross themselves by the rule, and close holes if asked") {
  const Folder folder;
  const Polyhedron a = make_box({0, 0, 0}, {2, 2, 2});
  const Polyhedron b = make_box({1, 1, 1}, {3, 3, 3});
  Triangles two = box({0, 0, 0}, {2, 2, 2});
  append(two, box({1, 1, 1}, {3, 3, 3}));
  two.push_back({Rational3{0, 0, 0}, Rational3{0, 0, 2}, Rational3{1, 1, 1}});  // makes one part of both
  two.push_back({Rational3{1, 1, 1}, Rational3{0, 0, 2}, Rational3{0, 0, 0}});
  const std::string overlapping = folder.write("two.off", off_of(soup(two)));
  Messages messages;
  CHECK(equal(read_shape_file(overlapping, scene_meshes(), &messages), unite(a, b)));
  REQUIRE(messages.size() == 1);
  CHECK_THAT(messages[0], Catch::EndsWith("selected points that are enclosed at least once"));
  const Polyhedron odd = read_shape_file(overlapping, {.crossings = Crossings::kOdd}, nullptr);
  CHECK(equal(odd, regularize(symmetric_difference(a, b))));
  CHECK_THROWS_WITH(read_shape_file(overlapping, {}, nullptr), Catch::Contains("union"));
  // What is inside out must not vanish from a scene.
  Triangles inside_out = box({1, 1, 1}, {3, 3, 3});
  for (auto& triangle : inside_out) std::swap(triangle[1], triangle[2]);
  append(inside_out, box({9, 0, 0}, {19, 9, 9}));
  const std::string turned = folder.write("turned.off", off_of(soup(inside_out)));
  messages.clear();
  CHECK(equal(read_shape_file(turned, scene_meshes(), &messages), unite(b, make_box({9, 0, 0}, {19, 9, 9}))));
  CHECK_THAT(messages.back(), Catch::Contains("parts of it are inside out"));
  Triangles open = box({0, 0, 0}, {2, 2, 2});
  open.pop_back();
  const std::string torn = folder.write("open.off", off_of(soup(open)));
  CHECK(volume(read_shape_file(torn, scene_meshes(), nullptr)) == Rational(0));
  MeshOptions closing = scene_meshes();
  closing.close_percent = 10;
  CHECK(equal(read_shape_file(torn, closing, nullptr), a));
}

}  // namespace
}  // namespace nef::planner::test

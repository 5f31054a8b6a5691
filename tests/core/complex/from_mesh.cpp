// SPDX-License-Identifier: Apache-2.0
//
// A mesh becomes the same solid, with the same notes or the same refusal, on any number of threads: it is checked
// before anything is made of it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/export/to_mesh.h"
#include "nef/io/native/native_binary.h"
#include "nef/polyhedron.h"

namespace nef::test {
namespace {

// The bytes of the solid and the notes, or why there is none.
std::string outcome(const Mesh& mesh, unsigned threads) {
  Messages notes;
  std::string result;
  try {
    result = native_binary(from_mesh(mesh, MeshOptions{.monitor = Monitor().on_threads(threads)}, &notes));
  } catch (const InputError& error) {
    result = error.what();
  }
  for (const std::string& note : notes) result += "\n" + note;
  return result;
}

void same_on_any_number(const Mesh& mesh) {
  const std::string on_one = outcome(mesh, 1);
  for (const unsigned threads : {2U, 3U, 0U}) CHECK(outcome(mesh, threads) == on_one);
}

// Two cubes as one mesh, the second one moved.
Mesh two_cubes(const Rational3& by) {
  Mesh mesh = to_mesh(make_box({0, 0, 0}, {4, 4, 4})).mesh;
  const std::size_t count = mesh.vertices.size();
  const Mesh cube = mesh;
  for (const Rational3& v : cube.vertices) mesh.vertices.push_back({v[0] + by[0], v[1] + by[1], v[2] + by[2]});
  for (std::size_t f = 0; f < cube.face_count(); ++f) {
    std::vector<std::uint32_t> face(cube.face(f).begin(), cube.face(f).end());
    for (std::uint32_t& v : face) v += static_cast<std::uint32_t>(count);
    mesh.push_face(face);
  }
  return mesh;
}

}  // namespace

TEST_CASE("meshes become the same solids on several threads", "[threads]") {
  same_on_any_number(two_cubes({8, 0, 0}));               // apart
  same_on_any_number(two_cubes({4, 1, 1}));               // touching in their faces
  same_on_any_number(two_cubes({4, 4, 4}));               // touching in a vertex
  same_on_any_number(two_cubes({2, 1, 1}));               // crossing
  same_on_any_number(two_cubes({0, 0, 0}));               // twice the same
  same_on_any_number(two_cubes({Rational(1, 3), 0, 0}));  // crossing in common planes
  Mesh inside_out = two_cubes({8, 0, 0});
  std::reverse(inside_out.corners.begin(), inside_out.corners.end());
  same_on_any_number(inside_out);
  Mesh half_turned = two_cubes({8, 0, 0});
  std::reverse(half_turned.corners.begin() + static_cast<std::ptrdiff_t>(half_turned.corners.size() / 2),
               half_turned.corners.end());
  same_on_any_number(half_turned);
}

// At the corner (4, 4, 4) of a cube a tetrahedron inside of it begins, turned like it: what is between them would be
// inside and outside. There are vertices like others before that corner and after it.
TEST_CASE("what is wrong in the middle of a mesh is told, checked or not", "[threads]") {
  Mesh mesh = two_cubes({8, 8, 8});
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Rational3& v : {Rational3{4, 4, 4}, Rational3{1, 2, 2}, Rational3{2, 1, 2}, Rational3{2, 2, 1}}) {
    mesh.vertices.push_back(v);
  }
  const Rational3& apex = mesh.vertices[first];
  REQUIRE(apex == Rational3{4, 4, 4});
  for (const std::array<std::uint32_t, 3>& t :
       {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}) {
    mesh.push_face(std::array<std::uint32_t, 3>{first + t[0], first + t[1], first + t[2]});
  }
  for (const bool check : {true, false}) {
    for (const unsigned threads : {1U, 2U}) {
      CHECK_THROWS_AS(from_mesh(mesh, MeshOptions{.check = check, .monitor = Monitor().on_threads(threads)}),
                      InputError);
    }
  }
}

// Faces that lie on each other, turned against each other: every vertex is a corner of both, an edge has both its faces
// in one plane, on one side of it.
TEST_CASE("folded surfaces enclose nothing, checked or not", "[threads]") {
  const auto mesh_of = [](std::vector<Rational3> vertices, const std::vector<std::vector<std::uint32_t>>& faces) {
    Mesh mesh;
    mesh.vertices = std::move(vertices);
    for (const std::vector<std::uint32_t>& face : faces) mesh.push_face(face);
    return mesh;
  };
  const std::vector<Rational3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Rational3> far{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}, {1, -5, -5}, {2, -6, -6}, {2, -5, -7}};
  const std::vector<Mesh> folded{
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}),
      mesh_of(square, {{0, 1, 2, 3}, {3, 2, 1, 0}}),
      mesh_of(square, {{0, 1, 2, 3}, {2, 1, 0}, {3, 2, 0}}),
      mesh_of(square, {{0, 1, 2}, {0, 2, 3}, {3, 2, 1}, {3, 1, 0}}),
  };
  for (const Mesh& mesh : folded) {
    same_on_any_number(mesh);
    for (const bool check : {true, false}) {
      for (const unsigned threads : {1U, 2U, 4U}) {
        CHECK_THROWS_WITH(from_mesh(mesh, MeshOptions{.check = check, .monitor = Monitor().on_threads(threads)}),
                          Catch::StartsWith("the faces of the mesh enclose nothing"));
      }
    }
  }
  // Beside a solid, and hanging on an edge of it, a fold adds nothing.
  const std::vector<std::vector<std::uint32_t>> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const Polyhedron alone = from_mesh(mesh_of(far, faces));
  for (const std::array<std::uint32_t, 3>& fold :
       {std::array<std::uint32_t, 3>{4, 5, 6}, {0, 1, 4}, {0, 5, 6}, {0, 1, 2}}) {
    auto more = faces;
    more.push_back({fold[0], fold[1], fold[2]});
    more.push_back({fold[0], fold[2], fold[1]});
    const Mesh mesh = mesh_of(far, more);
    same_on_any_number(mesh);
    for (const bool check : {true, false}) CHECK(equal(from_mesh(mesh, MeshOptions{.check = check}), alone));
  }
}

TEST_CASE("a mesh without vertices and faces is the empty set, and one with vertices only is none") {
  Messages notes;
  for (const bool surface : {false, true}) {
    CHECK(from_mesh(Mesh(), MeshOptions{.as_surface = surface}, &notes).is_empty());
    Mesh cloud;
    cloud.vertices = {{0, 0, 0}, {1, 0, 0}};
    CHECK_THROWS_WITH(from_mesh(cloud, MeshOptions{.as_surface = surface}), Catch::Contains("2 vertices but no faces"));
  }
  CHECK(notes == Messages(2, "the mesh has no faces, so it is the empty set"));
}

TEST_CASE("meshes that somebody has damaged become the same, or are refused alike, on several threads", "[threads]") {
  std::mt19937 random(5);
  const Mesh good = two_cubes({4, 4, 1});
  for (int round = 0; round < 60; ++round) {
    Mesh mesh = good;
    for (int changes = 1 + static_cast<int>(random() % 2); changes > 0; --changes) {
      if (random() % 2 == 0) {
        mesh.corners[random() % mesh.corners.size()] =
            static_cast<std::uint32_t>(random() % (mesh.vertices.size() + 1));
      } else {
        mesh.vertices[random() % mesh.vertices.size()][random() % 3] += static_cast<int>(random() % 5) - 2;
      }
    }
    same_on_any_number(mesh);
  }
}

}  // namespace nef::test

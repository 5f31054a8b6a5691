// SPDX-License-Identifier: Apache-2.0
//
// Sphere maps of ordinary vertices are read off their faces. Where doubles can not tell the directions of edges, as far
// from the origin of all doubles, they are drawn instead: both ways give the same solid.
#include <catch2/catch.hpp>
#include <map>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <variant>

#include "nef/construct/construct.h"
#include "nef/construct/solid.h"
#include "nef/import/checked_surface.h"
#include "nef/import/mesh_faces.h"
#include "nef/io/native/native_binary.h"
#include "nef/polyhedron.h"

namespace nef::test {
namespace {

// A star-shaped solid: an octahedron, subdivided, its vertices moved along their rays, so that edges bend both ways.
// Some vertices stay where coplanar faces meet.
Mesh star(std::mt19937& random) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<std::uint32_t, 3>> faces;
  for (std::uint32_t i = 0; i < 4; ++i) {
    faces.push_back({i, (i + 1) % 4, 4});
    faces.push_back({(i + 1) % 4, i, 5});
  }
  for (int level = 0; level < 2; ++level) {
    std::vector<std::array<std::uint32_t, 3>> finer;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, added] = middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (added) {
        Rational3 m;
        for (std::size_t i = 0; i < 3; ++i) m[i] = (mesh.vertices[a][i] + mesh.vertices[b][i]) / 2;
        mesh.vertices.push_back(m);
      }
      return found->second;
    };
    for (const auto& [a, b, c] : faces) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = finer;
  }
  for (Rational3& v : mesh.vertices) {
    const Rational by(4 + static_cast<int>(random() % 3), 4);
    for (Rational& x : v) x *= by;
  }
  for (const auto& face : faces) mesh.push_face(face);
  return mesh;
}

TEST_CASE("Rings that are read off the faces are those that would be drawn") {
  std::mt19937 random(3);
  for (int round = 0; round < 12; ++round) {
    const Mesh mesh = star(random);
    Integer far = 1;
    mpz_mul_2exp(far.get_mpz_t(), far.get_mpz_t(), 1100);
    Mesh large = mesh;
    for (Rational3& v : large.vertices) {
      for (Rational& x : v) x *= far;
    }
    const Polyhedron read = from_mesh(mesh);
    const Polyhedron drawn = from_mesh(large);
    CHECK(validate(read.complex()).empty());
    CHECK(validate(drawn.complex()).empty());
    const Rational back(1, far);
    CHECK(equal(transform(drawn, AffineMap::scale({back, back, back})), read));
    const Counts a = counts(read);
    const Counts b = counts(drawn);
    CHECK(std::tuple(a.vertices, a.edges, a.facets, a.volumes) == std::tuple(b.vertices, b.edges, b.facets, b.volumes));
  }
}

// All that is drawn is drawn by one way only, so the bytes are the same.
TEST_CASE("Solids with rings that are read are those with rings that are drawn, item for item") {
  std::mt19937 random(4);
  for (int round = 0; round < 40; ++round) {
    Mesh mesh = star(random);
    if (round % 2 == 0) {  // a second one, some of whose faces lie in planes of the first
      const Mesh more = star(random);
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      for (const Rational3& v : more.vertices) mesh.vertices.push_back({v[0] + 10, v[1] - 10, v[2]});
      for (std::uint32_t f = 0; f < more.face_count(); ++f) {
        std::vector<std::uint32_t> ring(more.face(f).begin(), more.face(f).end());
        for (std::uint32_t& v : ring) v += first;
        mesh.push_face(ring);
      }
    }
    const CheckedSurface checked(mesh, CheckedSurface::Extent::kAll, Crossings::kRefuse, {});
    REQUIRE_FALSE(checked.in_contact());
    const auto made = [&](SphereMaps maps) {
      return std::get<Complex>(try_make_solid(solid_faces(checked, {}, nullptr), {1, 1, 0}, {}, maps));
    };
    Complex read = made(SphereMaps::kRead);
    Complex drawn = made(SphereMaps::kDrawn);
    // Links of the first are told by the faces as far as its rings are read.
    CHECK(read.twin == drawn.twin);
    CHECK(read.corners == drawn.corners);
    CHECK(read.cycle_begin == drawn.cycle_begin);
    const std::string bytes_of_read = native_binary(Polyhedron(std::move(read)));
    const std::string bytes_of_drawn = native_binary(Polyhedron(std::move(drawn)));
    CHECK(bytes_of_read == bytes_of_drawn);
  }
}

}  // namespace
}  // namespace nef::test

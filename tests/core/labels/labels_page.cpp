// SPDX-License-Identifier: Apache-2.0
//
// The programs of docs/labels.md, and what they say.
#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>

#include "nef/construct/construct.h"
#include "nef/export/mesh_with_origins.h"
#include "nef/labeled_polyhedron.h"

namespace {

std::vector<bool> cut_by_b(const nef::Polyhedron& a, const nef::Polyhedron& b, nef::Mesh& mesh) {
  const std::vector<nef::Polyhedron> inputs{a, b};
  nef::MeshWithOrigins result = nef::mesh_with_origins(inputs, nef::membership("difference"));
  std::vector<bool> cut;
  for (const nef::InputSet& from : result.origins) cut.push_back(std::find(from.begin(), from.end(), 1U) != from.end());
  mesh = std::move(result.mesh);
  return cut;
}

nef::Rational in_two_fields() {
  nef::LabeledPolyhedron<int> depth(0);
  for (int i = 0; i < 3; ++i) {
    const nef::Polyhedron field = nef::make_box({2 * i, 0, 0}, {2 * i + 3, 1, 1});
    depth = overlay(depth, nef::LabeledPolyhedron<int>(field, 0, 1), std::plus<>());
  }
  return *nef::volume(depth.where([](int count) { return count == 2; }));
}

}  // namespace

TEST_CASE("the page on labels: faces that b cut, and counts") {
  nef::Mesh mesh;
  const std::vector<bool> cut =
      cut_by_b(nef::make_box({0, 0, 0}, {4, 4, 4}), nef::make_box({1, 1, 2}, {3, 3, 4}), mesh);
  REQUIRE(cut.size() == mesh.face_count());
  // The pocket: a floor and four walls, strictly inside of the block but for the rim.
  for (std::size_t f = 0; f < cut.size(); ++f) {
    const auto in_pocket = [&](std::uint32_t v) {
      const nef::Rational3& p = mesh.vertices[v];
      return p[0] >= 1 && p[0] <= 3 && p[1] >= 1 && p[1] <= 3 && p[2] >= 2;
    };
    const auto face = mesh.face(f);
    CHECK(cut[f] == std::all_of(face.begin(), face.end(), in_pocket));
  }
  CHECK(std::count(cut.begin(), cut.end(), true) == 10);
  CHECK(in_two_fields() == 2);
}

// SPDX-License-Identifier: Apache-2.0
//
// Meshes and unions that come in piece by piece are the sets that they are as a whole.

#include <catch2/catch.hpp>

#include "nef/base/error.h"
#include "nef/construct/round_shapes.h"
#include "nef/export/to_mesh.h"
#include "nef/io/mesh/mesh_reader.h"
#include "nef/tiles/import/mesh_tiles.h"
#include "nef/tiles/import/union_in_tiles.h"
#include "tests/support/paths.h"
#include "tests/tiles/cuts.h"

namespace nef::test {
namespace {

void same_in_pieces(const Mesh& mesh, const Tiling& tiling, unsigned threads, std::size_t piece,
                    const std::string& what) {
  Messages of_tiles;
  Messages of_whole;
  const Polyhedron whole = from_mesh(mesh, {}, &of_whole);
  const TiledPolyhedron tiles =
      tiles_from_mesh(mesh, {.monitor = Monitor().on_threads(threads)}, tiling, &of_tiles, piece);
  leaves_are_valid(tiles.tree(), what);
  glued_is(tiles, whole, what);
  if (of_tiles != of_whole) RC_FAIL(what + ": other messages");
}

Mesh turned_over(Mesh mesh) {
  Mesh result;
  result.vertices = std::move(mesh.vertices);
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    std::vector<std::uint32_t> face(mesh.face(f).rbegin(), mesh.face(f).rend());
    result.push_face(face);
  }
  return result;
}

}  // namespace

TEST_CASE("solids on a grid come in piece by piece") {
  CHECK(rc::check("pieces", [] {
    const Polyhedron solid = regularize((*recipes(true, 5).as("solid")).make());
    RC_PRE(!solid.is_empty());
    const Mesh mesh = to_mesh(solid).mesh;
    const Tiling tiling{*rc::gen::inRange<std::size_t>(8, 60)};
    const unsigned threads = *rc::gen::element(1U, 2U);
    same_in_pieces(mesh, tiling, threads, *rc::gen::inRange<std::size_t>(1, 12), "as it is");
    same_in_pieces(turned_over(mesh), tiling, threads, 6, "flipped");
  }));
}

TEST_CASE("real meshes and round shapes come in piece by piece", "[threads]") {
  for (const std::string name : {"star.off", "eight.off", "hand.off", "rotor.off", "hole.off", "sphere.ply"}) {
    INFO(name);
    const Mesh mesh = read_mesh(source_folder() + "/data/meshes/" + name);
    CHECK_NOTHROW(same_in_pieces(mesh, {300}, 2, mesh.face_count() / 20 + 1, name));
  }
  // A cavity, and an island in it.
  const Polyhedron onion = unite(subtract(make_sphere(10, 40), interior(make_sphere(8, 40))), make_sphere(5, 20));
  CHECK_NOTHROW(same_in_pieces(to_mesh(onion).mesh, {200}, 2, 150, "an onion"));
}

TEST_CASE("a mesh that bounds no solid is refused as it is in whole") {
  Mesh open = to_mesh(make_sphere(10, 30)).mesh;
  Mesh result;
  result.vertices = open.vertices;
  for (std::size_t f = 1; f < open.face_count(); ++f) result.push_face(open.face(f));
  std::string whole;
  try {
    static_cast<void>(from_mesh(result));
  } catch (const InputError& error) {
    whole = error.what();
  }
  CHECK(whole != "");
  CHECK_THROWS_WITH(tiles_from_mesh(result, {}, {100}, nullptr, 50), whole);
  // One of two spheres has the inside on the other side.
  Mesh two = to_mesh(make_sphere(10, 20)).mesh;
  const Mesh inner = to_mesh(make_sphere(5, 20)).mesh;
  const auto shift = static_cast<std::uint32_t>(two.vertices.size());
  two.vertices.insert(two.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  for (std::size_t f = 0; f < inner.face_count(); ++f) {
    std::vector<std::uint32_t> face(inner.face(f).begin(), inner.face(f).end());
    for (std::uint32_t& v : face) v += shift;
    two.push_face(face);
  }
  CHECK_THROWS_WITH(tiles_from_mesh(two, {}, {100}, nullptr, 40), Catch::Contains("contradict"));
}

TEST_CASE("unions of many sets, region by region", "[threads]") {
  for (const bool bounded : {true, false}) {
    CHECK(rc::check(bounded ? "bounded" : "unbounded", [bounded] {
      const auto recipes_of_pieces =
          *rc::gen::resize(12, rc::gen::container<std::vector<Recipe>>(recipes(bounded, 2))).as("pieces");
      std::vector<Polyhedron> sets;
      for (const Recipe& recipe : recipes_of_pieces) sets.push_back(recipe.make());
      const Tiling tiling{*rc::gen::inRange<std::size_t>(8, 60)};
      const Monitor monitor = Monitor().on_threads(*rc::gen::element(1U, 2U));
      const PieceSource source{.count = static_cast<std::uint32_t>(sets.size()),
                               .set = [&sets](std::uint32_t i, const Monitor&) { return sets[i]; }};
      const TiledPolyhedron united = union_in_tiles(source, tiling, *rc::gen::inRange<std::size_t>(1, 5), monitor);
      leaves_are_valid(united.tree(), "union");
      glued_is(united, unite_all(sets), "union");
      glued_is(TiledPolyhedron(sets, tiling, monitor), unite_all(sets), "all at once");
    }));
  }
}

TEST_CASE("regions are for sets that are spread") {
  const auto row = [](double step, double length) {
    std::vector<Box> boxes(64);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        boxes[i].low[axis] = axis == 0 ? step * static_cast<double>(i) : 0;
        boxes[i].high[axis] = boxes[i].low[axis] + length;
      }
    }
    return boxes;
  };
  CHECK(RegionalUnion(row(2, 1), 4).is_spread());
  CHECK(RegionalUnion(row(0, 1), 4).is_spread());  // one region, since no plane separates them
  CHECK_FALSE(RegionalUnion(row(1, 20), 4).is_spread());
}

TEST_CASE("many vertices are glued on several threads", "[threads]") {
  // More than a thread takes at once; boxes that touch in vertices and edges, and some that are cut.
  std::vector<Polyhedron> pieces;
  for (int x = 0; x < 11; ++x) {
    for (int y = 0; y < 11; ++y) {
      for (int z = 0; z < 11; ++z) {
        const int side = (x + y + z) % 7 == 0 ? 3 : 2;
        pieces.push_back(make_box({3 * x, 3 * y, 3 * z}, {3 * x + side, 3 * y + 2, 3 * z + 2}));
      }
    }
  }
  const TiledPolyhedron on_one(pieces, {.limit = 100});
  const TiledPolyhedron on_three(pieces, {.limit = 100}, Monitor().on_threads(3));
  const Polyhedron one = on_one.polyhedron();
  REQUIRE(one.complex().vertex_count() > 9000);
  CHECK(native_binary(one) == native_binary(on_three.polyhedron()));
  CHECK(native_binary(one) == native_binary(in_canonical_order(unite_all(pieces))));
}

}  // namespace nef::test

// SPDX-License-Identifier: Apache-2.0
//
// The piece of C++ on docs/tiles.md, as it is printed there (tests/docs/check_snippets.py compares them).
#include <catch2/catch.hpp>

#include "nef/construct/construct.h"
#include "nef/tiles/tiled_polyhedron.h"

TEST_CASE("the page on tiles: versions") {
  const nef::Polyhedron mesh_as_polyhedron = nef::make_box({0, 0, 0}, {4, 1, 1});
  const std::vector<nef::Polyhedron> tools{nef::make_box({0, 0, 0}, {1, 1, 1}), nef::make_box({3, 0, 0}, {4, 1, 1})};
  nef::TiledPolyhedron part(mesh_as_polyhedron);     // cut once
  std::vector<nef::TiledPolyhedron> versions{part};  // copies are O(1): undo is keeping a version
  for (const nef::Polyhedron& tool : tools) versions.push_back(subtract(versions.back(), tool));
  nef::Polyhedron whole = versions.back().polyhedron();  // joined, when needed
  CHECK(nef::volume(whole) == nef::Rational(2));
  CHECK(nef::volume(versions[1].polyhedron()) == nef::Rational(3));
}

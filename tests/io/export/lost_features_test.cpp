// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "nef/export/to_mesh.h"
#include "tests/support/shapes/random_polyhedra.h"

namespace nef {
namespace {

using test::set;

bool mentions(const std::vector<std::string>& lines, const std::string& text) {
  for (const std::string& line : lines) {
    if (line.find(text) != std::string::npos) return true;
  }
  return false;
}

TEST_CASE("What a mesh cannot hold is told") {
  CHECK(to_mesh(set("nothing")).lost.empty());
  CHECK(mentions(to_mesh(set("everything")).lost, "1 unbounded volume"));
  CHECK(mentions(to_mesh(set("halfspace(0,0,1,0)")).lost, "1 unbounded volume"));
  CHECK(to_mesh(set("halfspace(0,0,1,0)")).mesh.face_count() == 0);
  CHECK(mentions(to_mesh(set("! box(0,0,0,1,1,1)")).lost, "1 unbounded volume"));
  const MeshExport open = to_mesh(set("interior(box(0,0,0,1,1,1))"));
  CHECK(open.mesh.face_count() == 12);
  CHECK(open.lost.size() == 1);
  CHECK(mentions(open.lost, "written as closed: 6 facets, 12 edges, 8 vertices"));
  CHECK(mentions(to_mesh(set("box(0,0,0,1,1,1) - point(1,1,1)")).lost, "written as closed: 1 vertex"));
  const MeshExport flat = to_mesh(set("polygon(0,0,0, 1,0,0, 0,1,0) + point(5,5,5) + box(7,7,7,8,8,8)"));
  CHECK(flat.mesh.face_count() == 12);
  CHECK(mentions(flat.lost, "not in the mesh: 1 facet, 3 edges, 4 vertices"));
  const MeshExport crack = to_mesh(set("box(0,0,0,4,4,4) - polygon(1,1,1, 2,1,1, 1,2,1) - point(3,3,3)"));
  CHECK(crack.mesh.face_count() == 12);
  CHECK(mentions(crack.lost, "missing parts inside the solids were filled: 1 facet, 3 edges, 4 vertices"));
  // Vertices that look alike, beside the same volumes or not.
  const MeshExport many =
      to_mesh(set("interior(box(0,0,0,1,1,1)) + interior(box(2,0,0,3,1,1)) + box(4,0,0,5,1,1) + "
                  "(box(6,0,0,12,6,6) - boundary(box(7,1,1,8,2,2)) - boundary(box(9,1,1,10,2,2)))"));
  CHECK(mentions(many.lost, "written as closed: 12 facets, 24 edges, 16 vertices"));
  CHECK(mentions(many.lost, "missing parts inside the solids were filled: 12 facets, 24 edges, 16 vertices"));
  // Edges and facets that reach to infinity are no part of a mesh, and what is lost is counted all the same.
  const MeshExport far =
      to_mesh(set("interior(box(0,0,0,1,1,1)) + (halfspace(0,0,1,5) - interior(halfspace(0,1,1,5)))"));
  CHECK(mentions(far.lost, "1 unbounded volume"));
  CHECK(mentions(far.lost, "written as closed: 6 facets, 12 edges, 8 vertices"));
  // A bounded cell beside an unbounded one is a solid by itself.
  const MeshExport cell = to_mesh(set("halfspace(0,0,1,0) + box(0,0,1,1,1,2)"));
  CHECK(cell.mesh.face_count() == 12);
  CHECK(mentions(cell.lost, "1 unbounded volume"));
}

}  // namespace
}  // namespace nef

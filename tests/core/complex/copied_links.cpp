// SPDX-License-Identifier: Apache-2.0
//
// What an operation takes over from its operands must be what synthesis finds from the sphere maps alone, item for
// item.
#include <cstring>

#include "nef/export/to_mesh.h"
#include "nef/synthesis/synthesis.h"
#include "tests/laws/laws.h"

namespace nef::test {
namespace {

template <typename Item>
bool same_bytes(const std::vector<Item>& a, const std::vector<Item>& b) {
  static_assert(std::is_trivially_copyable_v<Item>);
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Item)) == 0);
}

bool same_facets(const FacetTable& a, const FacetTable& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Facet& f, const Facet& g) {
    return f.plane == g.plane && f.mark == g.mark && f.first_cycle == g.first_cycle && f.cycle_count == g.cycle_count &&
           f.first_isolated == g.first_isolated && f.isolated_count == g.isolated_count &&
           f.volume_above == g.volume_above && f.volume_below == g.volume_below;
  });
}

// The first array in which the complex differs from what synthesis makes of its sphere maps; empty if none does.
std::string difference_to_synthesis(const Complex& c) {
  Complex again;
  again.planes = c.planes;
  again.points = c.points;
  again.vertices = c.vertices;
  again.patterns = c.patterns;
  again.shalfedge_plane = c.shalfedge_plane;
  again.other_planes = c.other_planes;
  again.sloops = c.sloops;
  synthesize(again, c.volumes[kOuterVolume].mark, {});
  if (!same_bytes(c.twin.values(), again.twin.values())) return "twin";
  if (!same_bytes(c.svertex_owner.values(), again.svertex_owner.values())) return "svertex_owner";
  if (!same_bytes(c.pair_owner, again.pair_owner)) return "pair_owner";
  if (!same_facets(c.facets, again.facets)) return "facets";
  if (!same_bytes(c.cycle_begin.values(), again.cycle_begin.values())) return "cycle_begin";
  if (!same_bytes(c.corners, again.corners)) return "corners";
  if (!same_bytes(c.isolated_vertices, again.isolated_vertices)) return "isolated_vertices";
  if (!same_bytes(c.shalfedge_facet.pairs(), again.shalfedge_facet.pairs())) return "shalfedge_facet";
  if (!same_bytes(c.sloop_facet, again.sloop_facet)) return "sloop_facet";
  if (!same_bytes(c.sface_shell.values(), again.sface_shell.values())) return "sface_shell";
  if (c.shells.size() != again.shells.size() || c.volumes.size() != again.volumes.size()) return "volumes";
  for (const VolumeId i : c.volumes.ids()) {
    if (c.volumes[i].mark != again.volumes[i].mark || c.volumes[i].shell_count != again.volumes[i].shell_count) {
      return "volumes";
    }
  }
  return c.label_count == again.label_count ? "" : "label_count";
}

void is_as_synthesized(const Polyhedron& set, const std::string& what) {
  const std::string difference = difference_to_synthesis(set.complex());
  if (!difference.empty()) RC_FAIL(what + " differs from its synthesis in " + difference);
}

// Sets that keep much of each other untouched: many small parts on a large grid.
void all_operations_keep_links(bool bounded, std::size_t steps, int grid) {
  const Recipe first = *recipes(bounded, steps, grid).as("A");
  const Recipe second = *recipes(bounded, steps, grid).as("B");
  const Polyhedron a = first.make();
  const Polyhedron b = second.make();
  is_as_synthesized(a, "A");
  is_as_synthesized(unite(a, b), "A + B");
  is_as_synthesized(intersect(a, b), "A * B");
  is_as_synthesized(subtract(a, b), "A - B");
  is_as_synthesized(subtract(b, a), "B - A");
  is_as_synthesized(symmetric_difference(a, b), "A ^ B");
  // Labels: nothing merges, and what lies in the other operand gets other marks.
  const auto pairs = [](LabelId x, LabelId y) { return static_cast<LabelId>(2 * x + y); };
  const Polyhedron labels = overlay(a, b, pairs);
  is_as_synthesized(labels, "A and B as labels");
  is_as_synthesized(overlay(labels, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(3 - x + 4 * y); }),
                    "labels changed");
}

// Meshes bring links, too: closed solids with notches, holes, cavities and faces in one plane.
void meshes_bring_links(std::size_t steps, int grid) {
  const Recipe recipe = *recipes(true, steps, grid).as("solid");
  const Polyhedron solid = regularize(recipe.make());
  if (solid.is_empty()) return;
  for (const bool polygons : {false, true}) {
    MeshExportOptions options;
    options.keep_polygons = polygons;
    const Mesh mesh = to_mesh(solid, options).mesh;
    is_as_synthesized(from_mesh(mesh), polygons ? "the solid of polygons" : "the solid of triangles");
  }
}

}  // namespace

TEST_CASE("Operations keep the links that synthesis would find") {
  CHECK(rc::check("small grid", [] { all_operations_keep_links(true, 3, 3); }));
  CHECK(rc::check("large grid", [] { all_operations_keep_links(true, 8, 9); }));
  CHECK(rc::check("unbounded", [] { all_operations_keep_links(false, 4, 5); }));
}

TEST_CASE("Solids from meshes have the links that synthesis would find") {
  CHECK(rc::check("small grid", [] { meshes_bring_links(4, 3); }));
  CHECK(rc::check("large grid", [] { meshes_bring_links(9, 9); }));
}

TEST_CASE("An operation that changes nothing returns its first operand") {
  const Polyhedron a = set("box(0,0,0,9,9,9) - box(2,2,2,5,5,5) + box(20,0,0,21,1,1)");
  CHECK(&unite(a, set("box(6,6,6,7,7,7)")).complex() == &a.complex());
  CHECK(&subtract(a, set("box(3,3,3,4,4,4)")).complex() == &a.complex());
  CHECK(&intersect(a, set("box(-1,-1,-1,22,22,22)")).complex() == &a.complex());
  CHECK(&unite(a, set("box(3,3,3,4,4,4)")).complex() != &a.complex());
  CHECK(&symmetric_difference(a, set("box(6,6,6,7,7,7)")).complex() != &a.complex());
}

TEST_CASE("Facets of which only holes or only islands are new") {
  for (const char* text : {"box(0,0,0,9,9,9) - box(3,3,8,4,4,10) - box(5,5,8,6,6,10)",
                           "(box(0,0,0,9,9,9) - box(2,2,8,7,7,10)) + box(3,3,8,4,4,9)",
                           "(box(0,0,0,9,9,9) - box(2,2,8,7,7,10)) + box(3,3,8,4,4,9) + box(-5,-5,8,-4,-4,9)",
                           "(box(0,0,0,9,9,9) - box(2,2,8,7,7,10)) ^ box(1,1,1,8,8,20)",
                           "polygon(0,0,0, 9,0,0, 9,9,0, 0,9,0) - point(1,1,0) - point(2,2,0) - box(4,4,-1,5,5,1)",
                           "polygon(0,0,0, 9,0,0, 9,9,0, 0,9,0) - point(1,1,0) - box(20,20,-1,21,21,1)"}) {
    CHECK(difference_to_synthesis(set(text).complex()) == "");
    CHECK(validate(set(text).complex()) == "");
  }
}

}  // namespace nef::test

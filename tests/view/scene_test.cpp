// SPDX-License-Identifier: Apache-2.0
//
// What there is to draw of a set, against closed forms and against the exact measures of the set.
#include <rapidcheck.h>
#include <catch2/catch.hpp>
#include <cmath>

#include "apps/view/page/sphere_drawing.h"
#include "apps/view/picture/picture_camera.h"
#include "nef/base/error.h"
#include "nef/construct/round_shapes.h"
#include "nef/geometry/vectors.h"
#include "nef/tiles/questions/tile_queries.h"
#include "nef/tiles/tiled_polyhedron.h"
#include "view/sets.h"

namespace nef::view {
namespace {

double area(const Scene& scene, const SceneFacet& facet) {
  double sum = 0;
  for (std::uint32_t t = facet.first_triangle; t < facet.first_triangle + facet.triangle_count; ++t) {
    const auto& [a, b, c] = scene.triangles[t];
    const Point n = cross(minus(scene.vertices[b].position, scene.vertices[a].position),
                          minus(scene.vertices[c].position, scene.vertices[a].position));
    sum += std::sqrt(dot(n, n)) / 2;
  }
  return sum;
}

// By the divergence theorem, from the triangles around the selected volumes.
double enclosed_volume(const Scene& scene) {
  double sum = 0;
  for (const SceneFacet& facet : scene.facets) {
    const int sign =
        int{Scene::selected(scene.volumes[facet.below].mark)} - int{Scene::selected(scene.volumes[facet.above].mark)};
    for (std::uint32_t t = facet.first_triangle; t < facet.first_triangle + facet.triangle_count; ++t) {
      const auto& [a, b, c] = scene.triangles[t];
      sum += sign * dot(scene.vertices[a].position, cross(scene.vertices[b].position, scene.vertices[c].position)) / 6;
    }
  }
  return sum;
}

std::size_t count_origin(const Scene& scene, Origin origin) {
  return static_cast<std::size_t>(std::count_if(scene.facets.begin(), scene.facets.end(),
                                                [origin](const SceneFacet& facet) { return facet.origin == origin; }));
}

TEST_CASE("a cube has its items, and two triangles for each facet") {
  const Scene scene = build_scene(cube(0, 1));
  CHECK(scene.vertices.size() == 8);
  CHECK(scene.edges.size() == 12);
  CHECK(scene.facets.size() == 6);
  CHECK(scene.triangles.size() == 12);
  CHECK(scene.volumes.size() == 2);
  CHECK_FALSE(scene.box);
  for (const SceneFacet& facet : scene.facets) CHECK(area(scene, facet) == Approx(1));
  CHECK(enclosed_volume(scene) == Approx(1));
  const auto bounds = scene.bounds();
  REQUIRE(bounds);
  CHECK((*bounds)[0] == Point{0, 0, 0});
  CHECK((*bounds)[1] == Point{1, 1, 1});
}

TEST_CASE("facets with holes are filled around the hole only") {
  const Scene scene = build_scene(frame());
  std::vector<double> areas;
  for (const SceneFacet& facet : scene.facets) areas.push_back(area(scene, facet));
  std::sort(areas.begin(), areas.end());
  CHECK(areas.size() == 10);
  CHECK(areas[8] == Approx(12));
  CHECK(areas[9] == Approx(12));
  CHECK(enclosed_volume(scene) == Approx(12));
}

TEST_CASE("lower-dimensional parts and marks are told apart") {
  const Scene scene = build_scene(mixture());
  std::size_t isolated_vertices = 0;
  for (const SceneVertex& vertex : scene.vertices) {
    if (!vertex.isolated) continue;
    ++isolated_vertices;
    CHECK(vertex.position[0] == Approx(10.0 / 3));
    CHECK(vertex.mark == 1);
  }
  CHECK(isolated_vertices == 1);
  std::size_t isolated_edges = 0;
  std::size_t unselected_edges = 0;
  for (const SceneEdge& edge : scene.edges) {
    isolated_edges += edge.isolated ? 1 : 0;
    unselected_edges += edge.mark == 0 ? 1 : 0;
  }
  CHECK(isolated_edges == 1);
  // The upper facet was taken away with its boundary; the sheet's upper edge touches a corner of it only.
  CHECK(unselected_edges == 4);
  const auto unselected = std::count_if(scene.facets.begin(), scene.facets.end(), [](auto& f) { return f.mark == 0; });
  CHECK(unselected == 1);
}

TEST_CASE("unbounded parts end at a visible box and keep their indices") {
  const Polyhedron wedge = intersect(make_halfspace(1, 1, 0, -7), make_halfspace(0, 0, 1, -100));
  const Scene scene = build_scene(wedge);
  REQUIRE(scene.box);
  // Both planes and the line in which they meet are seen.
  CHECK((*scene.box)[0][2] < 100);
  CHECK((*scene.box)[1][2] > 100);
  CHECK(count_origin(scene, Origin::kOwn) == 2);
  CHECK(count_origin(scene, Origin::kBox) >= 3);
  for (const SceneVertex& vertex : scene.vertices) {
    CHECK(vertex.origin == Origin::kBox);
    CHECK(vertex.index == kArtificial);
  }
  const Complex& complex = wedge.complex();
  for (const SceneFacet& facet : scene.facets) {
    if (facet.origin == Origin::kBox) {
      CHECK(facet.index == kArtificial);
      continue;
    }
    REQUIRE(facet.index < complex.facet_count());
    CHECK(complex.facets[FacetId{facet.index}].mark == facet.mark);
    CHECK_FALSE(complex.planes.infimaximal(complex.facets[FacetId{facet.index}].plane));
  }
  const auto own = std::count_if(scene.edges.begin(), scene.edges.end(),
                                 [](const SceneEdge& edge) { return edge.index != kArtificial; });
  CHECK(own == 1);
  const auto selected = std::count_if(scene.volumes.begin(), scene.volumes.end(), [](const SceneVolume& volume) {
    return Scene::selected(volume.mark) && !volume.bounded && volume.index != kArtificial;
  });
  CHECK(selected == 1);
}

TEST_CASE("the complement of a cube shows the cube's walls from within the box") {
  const Scene scene = build_scene(complement(cube(0, 1)));
  REQUIRE(scene.box);
  CHECK(count_origin(scene, Origin::kOwn) == 6);
  CHECK(count_origin(scene, Origin::kBox) == 6);
  const auto& [low, high] = *scene.box;
  const double box = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
  CHECK(enclosed_volume(scene) == Approx(box - 1));
}

TEST_CASE("nothing and everything can be drawn") {
  const Scene nothing = build_scene(Polyhedron());
  CHECK(nothing.vertices.empty());
  CHECK(nothing.facets.empty());
  CHECK_FALSE(nothing.bounds());
  const Scene everything = build_scene(Polyhedron::everything());
  CHECK(everything.facets.size() == 6);
  CHECK(enclosed_volume(everything) == Approx(8));
}

TEST_CASE("a section is cut exactly and its items are found again") {
  SceneOptions options;
  options.section = {1, 0, 0, Rational(-1, 3)};
  const Scene scene = build_scene(cube(0, 1), options);
  CHECK(enclosed_volume(scene) == Approx(1.0 / 3));
  CHECK(count_origin(scene, Origin::kSection) == 1);
  for (const SceneFacet& facet : scene.facets) {
    if (facet.origin == Origin::kSection) CHECK(area(scene, facet) == Approx(1));
    CHECK((facet.index == kArtificial) == (facet.origin == Origin::kSection));
  }
  const auto kept = std::count_if(scene.vertices.begin(), scene.vertices.end(),
                                  [](const SceneVertex& vertex) { return vertex.index != kArtificial; });
  CHECK(kept == 4);
  options.section = {0, 0, 0, 1};
  CHECK_THROWS_AS(build_scene(cube(0, 1), options), InputError);
}

TEST_CASE("triangles enclose the exact volume of random unions of boxes") {
  CHECK(rc::check("volume of the scene", [] {
    Polyhedron set;
    const int boxes = *rc::gen::inRange(1, 4);
    for (int i = 0; i < boxes; ++i) {
      Rational3 low;
      Rational3 high;
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = *rc::gen::inRange(0, 4);
        high[k] = low[k] + *rc::gen::inRange(1, 3);
      }
      const Polyhedron box = make_box(low, high);
      set = *rc::gen::arbitrary<bool>() ? unite(set, box) : symmetric_difference(set, box);
    }
    const auto exact = volume(set);
    RC_ASSERT(exact.has_value());
    RC_ASSERT(std::abs(enclosed_volume(build_scene(set)) - nearest_double(*exact)) < 1e-9);
  }));
}

TEST_CASE("the scenes of tiles together show the set") {
  // Boxes on a grid have facets and edges in the walls of tiles; a sphere has none.
  const std::vector<Polyhedron> boxes{cube(0, 4), make_box({4, 0, 0}, {8, 2, 4}), make_box({2, 2, 2}, {6, 6, 6})};
  const Polyhedron open = subtract(unite_all(boxes), make_box({3, -1, 1}, {5, 3, 3}));
  for (const Polyhedron& set : {unite_all(boxes), open, make_sphere(2, 20), mixture()}) {
    const Scene whole = build_scene(set);
    double area_of_whole = 0;
    for (const SceneFacet& facet : whole.facets) area_of_whole += area(whole, facet);
    double area_of_tiles = 0;
    double volume_of_tiles = 0;
    std::size_t own = 0;
    const TiledPolyhedron tiled(set, {.limit = 12});
    CHECK(tiled.tile_count() > 1);
    for_each_leaf(tiled.tree(), [&](const TileRef& leaf, const Region& region) {
      if (leaf.node->kind == TileNode::Kind::kUniform) return;
      const Scene scene = build_tile_scene(leaf_set(leaf, region, {}));
      for (const SceneFacet& facet : scene.facets) area_of_tiles += area(scene, facet);
      volume_of_tiles += enclosed_volume(scene);
      own += static_cast<std::size_t>(std::count_if(scene.vertices.begin(), scene.vertices.end(),
                                                    [](const SceneVertex& v) { return v.origin == Origin::kOwn; }));
    });
    CHECK(area_of_tiles == Approx(area_of_whole));
    CHECK(volume_of_tiles == Approx(enclosed_volume(whole)));
    CHECK(own <= whole.vertices.size());
  }
}

TEST_CASE("the sphere map of a cube's corner is an octant") {
  const Polyhedron set = cube(0, 1);
  for (const VertexId v : set.complex().vertex_ids()) {
    const SphereDrawing drawing = draw_sphere_map(set.complex(), v);
    REQUIRE(drawing.dots.size() == 3);
    REQUIRE(drawing.arcs.size() == 3);
    REQUIRE(drawing.regions.size() == 2);
    CHECK(drawing.circles.empty());
    const Rational3 corner = set.complex().points.rational(point_of(v));
    for (const auto& dot_item : drawing.dots) {
      // From the corner into the cube along an axis.
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) sum += dot_item.direction[i] * (corner[i] == 0 ? 1 : -1);
      CHECK(sum == Approx(1));
    }
    for (const auto& arc : drawing.arcs) {
      // A quarter turn about the normal leads from the source to the target.
      const Point end = cross(arc.normal, drawing.dots[arc.source].direction);
      CHECK(dot(end, drawing.dots[arc.target].direction) == Approx(1));
      CHECK(drawing.regions[arc.left].mark != drawing.regions[arc.right].mark);
      CHECK(drawing.regions[arc.left].volume != drawing.regions[arc.right].volume);
    }
  }
}

TEST_CASE("a vertex inside a facet has a circle and keeps its mark") {
  const Polyhedron set = subtract(cube(0, 2), make_point({1, 1, 2}));
  const Complex& complex = set.complex();
  const Location where = locate(set, {1, 1, 2});
  REQUIRE(where.kind == Location::Kind::kVertex);
  const SphereDrawing drawing = draw_sphere_map(complex, where.vertex());
  CHECK(drawing.mark == 0);
  REQUIRE(drawing.circles.size() == 1);
  CHECK(std::abs(drawing.circles[0].normal[2]) == Approx(1));
  CHECK(drawing.circles[0].mark == 1);
  CHECK(drawing.regions.size() == 2);
}

}  // namespace
}  // namespace nef::view

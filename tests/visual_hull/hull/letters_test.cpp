// SPDX-License-Identifier: Apache-2.0
//
// The thesis' kind of example: three letters, one for each camera, with polygons of our own.
#include <algorithm>

#include "nef/polyhedron.h"
#include "nef/query/measures/approximate_volume.h"
#include "tests/support/paths.h"
#include "tests/visual_hull/helpers.h"

namespace nef::visual_hull {
namespace {

Scene letters() { return read_scene(source_folder() + "/data/visual_hull/letters/mpi.vsh"); }

// Inside all three letters as their cameras see them, by parity of the polygons: nothing of cones or Booleans.
bool seen_in_all(const Scene& scene, const Rational3& p) {
  return std::all_of(scene.views.begin(), scene.views.end(), [&p](const View& view) {
    const Projection q = view.camera.project(p);
    const Point2 at(q.x / q.depth, q.y / q.depth);
    bool inside = false;
    for (const Ring& ring : view.polygons.value()) {
      const Side side = locate(ring, at);
      if (side == Side::kBoundary) return true;
      inside = inside != (side == Side::kInside);
    }
    return inside;
  });
}

TEST_CASE("M, P and I: both legs of the M carry the hole of the P") {
  const Scene scene = letters();
  const Result result = compute(scene, {}, {});
  CHECK(nef::validate(result.hull.complex()) == "");
  // CGAL 5.5, intersecting the cones one after the other, gets the same counts (nef_bench_visual_hull).
  const nef::Counts counts = nef::counts(result.hull);
  CHECK(counts.vertices == 84);
  CHECK(counts.facets == 42);
  CHECK(counts.volumes == 2);
  // The I lies on its side: its two bars run along y through the legs of the M, and in each of them the P is whole. One
  // piece with two tunnels has genus 2: V - E + F = 2 - 2 * 2, inside and outside.
  CHECK(nef::euler_numbers(result.hull) == std::vector<long>{-2, -2});
  CHECK(nef::approximate_volume(result.hull).value ==
        Approx(nef::nearest_double(nef::volume(result.hull).value())).epsilon(1e-12));
}

TEST_CASE("M, P and I: a point is in the hull iff all cameras see it in their letter, whatever the order") {
  Scene scene = letters();
  const nef::Polyhedron hull = compute(scene, {}, {}).hull;
  testing::property("membership", [&] {
    Rational3 p;
    for (Rational& c : p) c = Rational(*rc::gen::inRange(-36, 37)) / 4;
    RC_ASSERT(nef::contains(hull, p) == seen_in_all(scene, p));
  });
  std::vector<std::size_t> order{0, 1, 2};
  while (std::next_permutation(order.begin(), order.end())) {
    Scene turned;
    turned.box = scene.box;
    for (const std::size_t i : order) turned.views.push_back(scene.views[i]);
    CHECK(nef::equal(compute(turned, {}, {}).hull, hull));
  }
}

TEST_CASE("Vertices of the letters' hull lie on three cone planes each, as cameras see them") {
  const Scene scene = letters();
  const Result result = compute(scene, {}, {});
  const nef::Complex& c = result.hull.complex();
  for (const nef::VertexId v : c.vertex_ids()) {
    std::size_t planes = 0;
    for (const View& view : scene.views) {
      const Projection q = view.camera.project(c.points.rational(nef::point_of(v)));
      const Point2 at(q.x / q.depth, q.y / q.depth);
      for (const Ring& ring : view.polygons.value()) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
          planes += on_segment(ring[i], ring[(i + 1) % ring.size()], at) ? 1 : 0;
        }
      }
    }
    CHECK(planes >= 3);  // a vertex of a letter lies on two of its edges
  }
}

TEST_CASE("Any number of threads gives the same complex", "[threads]") {
  const Scene scene = read_scene(source_folder() + "/data/visual_hull/eight/eight.json");
  Options options;
  options.silhouette.simplify.tolerance = 2;
  options.way = Way::kCones;
  const std::filesystem::path folder = source_folder() + "/data/visual_hull/eight";
  const Result one = compute(scene, folder, options);
  options.monitor = nef::Monitor().on_threads(3);
  const Result three = compute(scene, folder, options);
  const nef::Complex& a = one.hull.complex();
  const nef::Complex& b = three.hull.complex();
  REQUIRE(a.vertex_count() == b.vertex_count());
  for (const nef::VertexId v : a.vertex_ids()) {
    CHECK(a.points.rational(nef::point_of(v)) == b.points.rational(nef::point_of(v)));
  }
  CHECK(nef::equal(one.hull, three.hull));
  CHECK(one.phases[static_cast<std::size_t>(Phase::kIntersection)].predicates.filter ==
        three.phases[static_cast<std::size_t>(Phase::kIntersection)].predicates.filter);
}

}  // namespace
}  // namespace nef::visual_hull

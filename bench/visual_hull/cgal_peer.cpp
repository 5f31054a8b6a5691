// SPDX-License-Identifier: Apache-2.0
#include "bench/visual_hull/cgal_peer.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>

#include <ctime>
#include <sstream>

namespace nef::visual_hull::bench {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Surface = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

Kernel::FT number(const Rational& value) {
  std::istringstream stream(nef::to_string(value));
  Kernel::FT result;
  stream >> result;
  return result;
}

Kernel::Point_3 point(const Rational3& p) { return {number(p[0]), number(p[1]), number(p[2])}; }

/// A closed surface from points and faces.
class Builder : public CGAL::Modifier_base<Surface::HalfedgeDS> {
 public:
  std::vector<Rational3> points;
  std::vector<std::vector<std::size_t>> faces;

  void operator()(Surface::HalfedgeDS& hds) override {
    CGAL::Polyhedron_incremental_builder_3<Surface::HalfedgeDS> builder(hds, true);
    builder.begin_surface(points.size(), faces.size());
    for (const Rational3& p : points) builder.add_vertex(point(p));
    for (const auto& face : faces) builder.add_facet(face.begin(), face.end());
    builder.end_surface();
  }
};

Nef solid(Builder& builder) {
  Surface surface;
  surface.delegate(builder);
  return Nef(surface);
}

/// The pyramid of one ring, from the apex to a depth.
Nef pyramid(const Camera& camera, const Ring& ring, const Rational& depth) {
  Builder builder;
  builder.points.push_back(camera.centre());
  const std::size_t n = ring.size();
  for (const Point2& p : ring) {
    Rational3 q = camera.ray(p);
    for (std::size_t i = 0; i < 3; ++i) q[i] = camera.centre()[i] + depth * q[i];
    builder.points.push_back(q);
  }
  const bool flip = (ring_orientation(ring, {}) > 0) == (camera.handedness() > 0);
  std::vector<std::size_t> cap;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t a = 1 + i;
    const std::size_t b = 1 + (i + 1) % n;
    builder.faces.push_back(flip ? std::vector<std::size_t>{0, b, a} : std::vector<std::size_t>{0, a, b});
    cap.push_back(flip ? a : 1 + (n - 1 - i));
  }
  builder.faces.push_back(cap);
  return solid(builder);
}

Nef cone(const ViewResult& view, const WorldBox& box) {
  const Rational depth = depth_range(view.camera, box).farthest * 2;
  Nef result;
  for (const Ring& ring : view.silhouette.region.rings) {
    result = result.symmetric_difference(pyramid(view.camera, ring, depth));
  }
  return result.regularization();
}

Nef box_solid(const WorldBox& box) {
  Builder builder;
  for (unsigned k = 0; k < 8; ++k) {
    builder.points.push_back({(k & 1U) != 0 ? box.high[0] : box.low[0], (k & 2U) != 0 ? box.high[1] : box.low[1],
                              (k & 4U) != 0 ? box.high[2] : box.low[2]});
  }
  builder.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return solid(builder);
}

}  // namespace

PeerResult intersect_with_cgal(const std::vector<ViewResult>& views, const WorldBox& box) {
  std::vector<Nef> cones{box_solid(box)};
  for (const ViewResult& view : views) cones.push_back(cone(view, box));
  const std::clock_t start = std::clock();
  Nef hull = cones[0];
  for (std::size_t i = 1; i < cones.size(); ++i) hull = hull * cones[i];
  PeerResult result;
  result.seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  result.vertices = hull.number_of_vertices();
  result.facets = hull.number_of_facets();
  return result;
}

}  // namespace nef::visual_hull::bench

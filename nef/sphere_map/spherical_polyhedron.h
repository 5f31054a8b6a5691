// SPDX-License-Identifier: Apache-2.0
//
// Sphere maps as sets of their own: planar Nef polyhedra on the sphere (thesis chapter 3 and 4.3),
// made from half-spheres, great circles, great arcs and points. The code is that of the local
// pyramids of a 3D polyhedron.
#pragma once

#include <memory>

#include "nef/base/monitor.h"
#include "nef/geometry/integer_vector.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {

/// A set of directions with exact boundary: a value, immutable, cheap to copy.
class SphericalPolyhedron {
 public:
  /// The empty set.
  SphericalPolyhedron();
  static SphericalPolyhedron whole_sphere();
  /// Directions x with normal.x < 0 (or <= 0). Throws InputError for the zero vector, as all below.
  static SphericalPolyhedron half_sphere(const Integer3& normal, bool closed = true);
  /// Directions x with normal.x = 0.
  static SphericalPolyhedron great_circle(const Integer3& normal, const Monitor& monitor = {});
  /// The closed arc from a to b, shorter than a half circle; a point if they are the same direction.
  /// Throws InputError if they are opposite.
  static SphericalPolyhedron great_arc(const Integer3& a, const Integer3& b, const Monitor& monitor = {});
  static SphericalPolyhedron point(const Integer3& direction, const Monitor& monitor = {});
  /// The local pyramid of somebody else's complex or query, without its centre.
  SphericalPolyhedron(const PlaneTable& planes, const SphereMapView& map);

  /// Items, incidences and marks; see nef/sphere_map/sphere_map.h for how to walk them.
  [[nodiscard]] SphereMapView map() const { return body_->map.view(); }
  /// The planes that the items of map() refer to; only their normals matter.
  [[nodiscard]] const PlaneTable& planes() const { return body_->planes; }

  [[nodiscard]] bool is_empty() const { return map().trivial() && map().sfaces[0].mark == 0; }
  [[nodiscard]] bool is_whole_sphere() const { return map().trivial() && map().sfaces[0].mark == 1; }
  /// O(size).
  [[nodiscard]] bool contains(const Integer3& direction) const;
  [[nodiscard]] SphereLocation locate(const Integer3& direction) const;

 private:
  friend SphericalPolyhedron combine(const SphericalPolyhedron&, const SphericalPolyhedron&,
                                     LabelId (*f)(LabelId, LabelId), const Monitor& monitor);
  friend SphericalPolyhedron change_marks(const SphericalPolyhedron&, bool select_lower, bool keep_faces,
                                          const Monitor& monitor);
  friend SphericalPolyhedron complement(const SphericalPolyhedron&);

  struct Body {
    PlaneTable planes;
    SphereMapBuffer map;
  };
  explicit SphericalPolyhedron(Body&& body) : body_(std::make_shared<const Body>(std::move(body))) {}
  std::shared_ptr<const Body> body_;
};

// O(n m) for small maps, O((n + m + k) log(n + m)) for large ones with k crossings.
SphericalPolyhedron unite(const SphericalPolyhedron& a, const SphericalPolyhedron& b, const Monitor& monitor = {});
SphericalPolyhedron intersect(const SphericalPolyhedron& a, const SphericalPolyhedron& b, const Monitor& monitor = {});
SphericalPolyhedron subtract(const SphericalPolyhedron& a, const SphericalPolyhedron& b, const Monitor& monitor = {});
SphericalPolyhedron symmetric_difference(const SphericalPolyhedron& a, const SphericalPolyhedron& b,
                                         const Monitor& monitor = {});
bool equal(const SphericalPolyhedron& a, const SphericalPolyhedron& b, const Monitor& monitor = {});

// O(n log n).
SphericalPolyhedron complement(const SphericalPolyhedron& a);
SphericalPolyhedron interior(const SphericalPolyhedron& a, const Monitor& monitor = {});
SphericalPolyhedron closure(const SphericalPolyhedron& a, const Monitor& monitor = {});
SphericalPolyhedron boundary(const SphericalPolyhedron& a, const Monitor& monitor = {});
/// The closure of the interior.
SphericalPolyhedron regularize(const SphericalPolyhedron& a, const Monitor& monitor = {});

}  // namespace nef

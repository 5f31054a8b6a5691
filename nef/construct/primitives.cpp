// SPDX-License-Identifier: Apache-2.0
//
// Boxes and half-spaces.
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/construct/solid.h"
#include "nef/geometry/vectors.h"
#include "nef/number/brief_text.h"
#include "nef/polyhedron.h"

namespace nef {

Polyhedron make_box(const Rational3& low, const Rational3& high, const Monitor& monitor) {
  int extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (low[i] > high[i]) {
      throw InputError("a box needs its lower corner first: its " + std::string(1, "xyz"[i]) + " goes from " +
                       brief_text(low[i]) + " to " + brief_text(high[i]));
    }
    if (low[i] < high[i]) ++extent;
  }
  if (extent < 3) {
    std::vector<Rational3> corners;
    for (int i = 0; i < 8; ++i) {
      Rational3 p;
      bool distinct = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const bool upper = ((i >> k) & 1) != 0;
        if (upper && low[k] == high[k]) distinct = false;
        p[k] = upper ? high[k] : low[k];
      }
      if (distinct) corners.push_back(p);
    }
    if (extent == 0) return make_point(corners[0], monitor);
    if (extent == 1) return make_segment(corners[0], corners[1], monitor);
    std::swap(corners[2], corners[3]);
    const std::vector<std::vector<Rational3>> ring{corners};
    return make_polygon(ring, monitor);
  }
  SolidFaces f;
  for (int i = 0; i < 8; ++i) {
    f.points.push({(i & 1) != 0 ? high[0] : low[0], (i & 2) != 0 ? high[1] : low[1], (i & 4) != 0 ? high[2] : low[2]});
  }
  add_box_sides(f, [&](std::size_t i) {
    Rational3 normal;
    normal[i / 2] = i % 2 == 0 ? -1 : 1;
    return f.planes.intern(normal, i % 2 == 0 ? low[i / 2] : Rational(-high[i / 2]));
  });
  return Polyhedron(make_solid(std::move(f), {1, 1, 0}, monitor));
}

Polyhedron make_halfspace(const Rational& a, const Rational& b, const Rational& c, const Rational& d, bool closed,
                          const Monitor& monitor) {
  const Rational3 n{a, b, c};
  if (is_zero(n)) throw InputError("a half-space needs a normal that is not (0,0,0)");
  // A map that takes z <= 0 to it: columns u, v orthogonal to n, then n; the origin goes to the
  // plane's point nearest to it.
  const Rational3 u = across(n);
  const Rational3 v = cross(n, u);
  const Rational square = dot(n, n);
  AffineMap map;
  for (std::size_t i = 0; i < 3; ++i) {
    map.linear[i] = {u[i], v[i], n[i]};
    map.translation[i] = -d * n[i] / square;
  }
  const Polyhedron result = transform(Polyhedron(make_lower_halfspace(monitor)), map, monitor);
  return closed ? result : interior(result, monitor);
}

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/morphology.h"

#include "apps/minkowski/morphology/structuring_set.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {
Polyhedron erode(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options, MinkowskiReport* report) {
  return complement(minkowski_sum(complement(a), negate(b, options.monitor), options, report));
}

Polyhedron opening(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options, MinkowskiReport* report) {
  require_structuring_set(b);
  return minkowski_sum(erode(a, b, options, report), b, options, report);
}

Polyhedron closing(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options, MinkowskiReport* report) {
  require_structuring_set(b);
  return erode(minkowski_sum(a, b, options, report), b, options, report);
}

Polyhedron offset(const Polyhedron& a, const Rational& radius, int splits, Side side, const MinkowskiOptions& options,
                  MinkowskiReport* report) {
  if (sgn(radius) == 0) return without_labels(a, options.monitor);
  const Side of_ball = ball_side(sgn(radius), side);
  const Polyhedron ball =
      to_polyhedron(ball_approximation(abs(radius), splits, of_ball, options.monitor).cell, options.monitor);
  return sgn(radius) > 0 ? minkowski_sum(a, ball, options, report) : erode(a, ball, options, report);
}

Polyhedron sweep(const Polyhedron& a, std::span<const Rational3> path, const MinkowskiOptions& options,
                 MinkowskiReport* report) {
  if (path.empty()) throw InputError("a sweep needs a path of at least one point");
  std::vector<Polyhedron> way = {make_point(path[0], options.monitor)};
  for (std::size_t k = 1; k < path.size(); ++k) way.push_back(make_segment(path[k - 1], path[k], options.monitor));
  return minkowski_sum(a, unite_all(way, options.monitor), options, report);
}

Polyhedron no_fit_set(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                      MinkowskiReport* report) {
  const Monitor& monitor = options.monitor;
  const Polyhedron turned = negate(b, monitor);
  const Polyhedron contact = minkowski_sum(closure(a, monitor), closure(turned, monitor), options, report);
  const Polyhedron overlap = minkowski_sum(interior(a, monitor), interior(turned, monitor), options, report);
  return subtract(contact, overlap, monitor);
}

}  // namespace nef::minkowski

// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convex/tools.h"

#include <cmath>
#include <vector>

#include "nef/base/error.h"
#include "nef/number/brief_text.h"

namespace nef::minkowski {
namespace {

Rational grid(double value) {
  Rational result(Integer(std::lround(std::ldexp(value, 20))), Integer(1) << 20);
  result.canonicalize();
  return result;
}

// The rational point of the unit sphere next to (x, y, z), all >= 0, by stereographic projection
// from (0, 0, -1): (2s, 2t, 1 - s^2 - t^2) / (1 + s^2 + t^2). On the circle z = 0 it is done from (-1, 0),
// so that the point stays there.
Rational3 on_sphere(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  if (z == 0) {
    const Rational t = grid(y / (length + x));
    const Rational w = 1 + t * t;
    return {Rational((1 - t * t) / w), Rational(2 * t / w), Rational(0)};
  }
  const Rational s = grid(x / (length + z));
  const Rational t = grid(y / (length + z));
  const Rational square = s * s + t * t;
  const Rational w = 1 + square;
  return {Rational(2 * s / w), Rational(2 * t / w), Rational((1 - square) / w)};
}

}  // namespace

ConvexCell ball(const Rational& radius, int splits, const Monitor& monitor) {
  if (sgn(radius) <= 0) throw InputError("the radius of a ball must be positive, not " + brief_text(radius));
  if (splits < 1 || splits > 64) {
    throw InputError("a ball has 1 to 64 splits per edge, not " + std::to_string(splits) + " (4 N^2 + 2 vertices)");
  }
  std::vector<Rational3> points;
  for (int i = 0; i <= splits; ++i) {
    for (int j = 0; i + j <= splits; ++j) {
      const int k = splits - i - j;
      const Rational3 p = on_sphere(i, j, k);
      for (int signs = 0; signs < 8; ++signs) {
        Rational3 q;
        for (std::size_t a = 0; a < 3; ++a)
          q[a] = (signs >> a & 1) != 0 ? Rational(-radius * p[a]) : Rational(radius * p[a]);
        points.push_back(q);
      }
    }
  }
  return hull_cell(points, monitor);
}

ConvexCell box_tool(const Rational3& extents, const Monitor& monitor) {
  std::vector<Rational3> points;
  for (int signs = 0; signs < 8; ++signs) {
    Rational3 p;
    for (std::size_t a = 0; a < 3; ++a) {
      if (sgn(extents[a]) < 0) throw InputError("an extent of a box must not be negative: " + brief_text(extents[a]));
      p[a] = (signs >> a & 1) != 0 ? Rational(-extents[a] / 2) : Rational(extents[a] / 2);
    }
    points.push_back(p);
  }
  return hull_cell(points, monitor);
}

}  // namespace nef::minkowski

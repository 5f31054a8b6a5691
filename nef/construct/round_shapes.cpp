// SPDX-License-Identifier: Apache-2.0
#include "nef/construct/round_shapes.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/number/brief_text.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

// The cosine of an angle between 0 and 90 degrees.
double cosine_in_quadrant(double degrees) {
  if (degrees == 0) return 1;
  if (degrees == 30) return std::sqrt(3.0) / 2;
  if (degrees == 60) return 0.5;
  if (degrees == 90) return 0;
  return degrees <= 45 ? std::cos(degrees * M_PI / 180) : std::sin((90 - degrees) * M_PI / 180);
}

// Of an angle in [0, 360), so that mirror images are mirror images to the last bit.
std::array<double, 2> cosine_and_sine(double degrees) {
  const double folded = degrees > 180 ? 360 - degrees : degrees;
  const double acute = folded > 90 ? 180 - folded : folded;
  const double x = cosine_in_quadrant(acute);
  const double y = cosine_in_quadrant(90 - acute);
  return {folded > 90 ? -x : x, degrees > 180 ? -y : y};
}

void require_fragments(unsigned fragments) {
  if (fragments < 3) throw InputError("a round shape needs three corners at least");
  constexpr unsigned kMost = 100000;
  if (fragments > kMost) throw InputError("a round shape has 100000 corners at most");
}

void add_ring(std::vector<Rational3>& points, const std::vector<std::array<Rational, 2>>& circle,
              const Rational& radius, const Rational& z) {
  if (radius == 0) {
    points.push_back({0, 0, z});
    return;
  }
  for (const auto& [x, y] : circle) points.push_back({radius * x, radius * y, z});
}

}  // namespace

std::vector<std::array<Rational, 2>> unit_circle(unsigned fragments) {
  require_fragments(fragments);
  std::vector<std::array<Rational, 2>> corners;
  corners.reserve(fragments);
  for (unsigned i = 0; i < fragments; ++i) {
    const auto [x, y] = cosine_and_sine(360.0 * i / fragments);
    corners.push_back({exact_rational(x), exact_rational(y)});
  }
  return corners;
}

Polyhedron make_sphere(const Rational& radius, unsigned fragments, const Monitor& monitor) {
  require_fragments(fragments);
  if (radius <= 0) throw InputError("the radius of a sphere must be positive, not " + brief_text(radius));
  const std::vector<std::array<Rational, 2>> circle = unit_circle(fragments);
  const unsigned rings = (fragments + 1) / 2;
  std::vector<Rational3> points;
  for (unsigned i = 0; i < rings; ++i) {
    const auto [z, r] = cosine_and_sine(180.0 * (i + 0.5) / rings);
    add_ring(points, circle, radius * exact_rational(r), radius * exact_rational(z));
  }
  return convex_hull(points, monitor);
}

Polyhedron make_cylinder(const Rational& height, const Rational& bottom, const Rational& top, unsigned fragments,
                         const Monitor& monitor) {
  require_fragments(fragments);
  if (height <= 0) throw InputError("the height of a cylinder must be positive, not " + brief_text(height));
  for (const Rational& radius : {bottom, top}) {
    if (radius < 0) throw InputError("the radius of a cylinder must not be negative: " + brief_text(radius));
  }
  if (bottom == 0 && top == 0) throw InputError("one radius of a cylinder must be positive");
  const std::vector<std::array<Rational, 2>> circle = unit_circle(fragments);
  std::vector<Rational3> points;
  add_ring(points, circle, bottom, 0);
  add_ring(points, circle, top, height);
  return convex_hull(points, monitor);
}

unsigned openscad_fragments(double radius, double number, double angle, double size) {
  constexpr double kSmallest = 1e-6;
  if (radius < kSmallest || !std::isfinite(number)) return 3;
  if (number > 0) return static_cast<unsigned>(std::clamp(number, 3.0, 4e9));
  const double sides = std::max(std::min(360 / angle, radius * 2 * M_PI / size), 5.0);
  return static_cast<unsigned>(std::ceil(std::clamp(sides, 5.0, 4e9)));
}

}  // namespace nef

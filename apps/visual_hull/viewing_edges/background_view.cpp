// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/background_view.h"

#include <algorithm>

namespace nef::visual_hull {
namespace {

/// Corners of a rectangle whose interior holds all that it has been told.
class Surrounding {
 public:
  void add(const Rational& u, const Rational& v) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const Rational& x = axis == 0 ? u : v;
      low_[axis] = any_ ? std::min(low_[axis], x) : x;
      high_[axis] = any_ ? std::max(high_[axis], x) : x;
    }
    any_ = true;
  }

  [[nodiscard]] Ring ring() const {
    std::array<double, 2> low{};
    std::array<double, 2> high{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      // Much more than the corners lose when they are rounded to doubles.
      const Rational largest = std::max(Rational(abs(low_[axis])), Rational(abs(high_[axis])));
      const Rational margin = (high_[axis] - low_[axis]) / 16 + largest / 1024;
      low[axis] = nef::nearest_double(Rational(low_[axis] - margin));
      high[axis] = nef::nearest_double(Rational(high_[axis] + margin));
    }
    return {Point2::from_doubles(low[0], low[1]), Point2::from_doubles(high[0], low[1]),
            Point2::from_doubles(high[0], high[1]), Point2::from_doubles(low[0], high[1])};
  }

 private:
  bool any_ = false;
  std::array<Rational, 2> low_;
  std::array<Rational, 2> high_;
};

}  // namespace

std::optional<Silhouette> beside_background(const Camera& camera, const Silhouette& background, const WorldBox& box,
                                            const nef::Monitor& monitor) {
  Surrounding surrounding;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    Rational3 point;
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = ((corner >> axis & 1U) != 0 ? box.high : box.low)[axis];
    const Projection seen = camera.project(point);
    if (sgn(seen.depth) <= 0) return std::nullopt;
    surrounding.add(seen.x / seen.depth, seen.y / seen.depth);
  }
  std::vector<Ring> rings = background.rings;
  for (const Ring& ring : rings) {
    for (const Point2& p : ring) surrounding.add(p.x(), p.y());
  }
  rings.push_back(surrounding.ring());
  return nest(std::move(rings), monitor);
}

}  // namespace nef::visual_hull

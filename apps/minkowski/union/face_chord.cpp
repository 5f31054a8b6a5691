// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/union/face_chord.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"

namespace nef::minkowski {

// The sides of the plane on which the face's corners are: by doubles where these are sure, exactly for the others.
FaceCutter::Side FaceCutter::find_sides(std::uint32_t face, std::uint32_t other) {
  const std::uint32_t cell = rounded_.cell_of_face(face);
  const auto ring = exact_.corners(face);
  const RoundedFace& plane = rounded_.face(other);
  sides_.clear();
  values_.clear();
  bool above = false;
  bool below = false;
  bool doubtful = false;
  for (const std::uint32_t v : ring) {
    const double value = plane.value(rounded_.vertices(cell)[v]);
    const int side = value > plane.slack ? 1 : value < -plane.slack ? -1 : 0;
    values_.push_back(value);
    sides_.push_back(side);
    above = above || side > 0;
    below = below || side < 0;
    doubtful = doubtful || side == 0;
  }
  if (!doubtful) return above && below ? Side::kThrough : Side::kOff;
  if (exact_.plane(face).row() == exact_.plane(other).row()) return Side::kOff;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    if (sides_[k] == 0) sides_[k] = exact_.side(other, cell, ring[k]);
    above = above || sides_[k] > 0;
    below = below || sides_[k] < 0;
  }
  return above && below ? Side::kThrough : Side::kOff;
}

std::optional<Chord> FaceCutter::chord(std::uint32_t face, std::uint32_t other) {
  if (find_sides(face, other) == Side::kOff) return std::nullopt;
  const auto ring = exact_.corners(face);
  const std::span<const Double3> v = rounded_.vertices(rounded_.cell_of_face(face));
  Chord result;
  std::size_t count = 0;
  for (std::size_t k = 0; k < ring.size() && count < 2; ++k) {
    const std::size_t next = (k + 1) % ring.size();
    if (sides_[k] == 0) {
      result.point[count++] = v[ring[k]];
      result.error = std::max(result.error, rounded_.vertex_error());
    } else if (sides_[k] * sides_[next] < 0) {
      add_crossing(v[ring[k]], v[ring[next]], values_[k], values_[next], rounded_.face(other).slack,
                   result.point[count++], result.error);
    }
  }
  NEF_ASSERT(count == 2);  // a plane through the inside of a convex polygon
  return result;
}

// A point of the edge pq where a form is zero that has values a, b of opposite signs at its ends, each within `slack`.
void FaceCutter::add_crossing(const Double3& p, const Double3& q, double a, double b, double slack, Double3& point,
                              double& error) const {
  const double span = std::fabs(a - b);
  // The quotient a / (a - b), at most 1, has an error of up to (slack + 2 slack) / (span - 2 slack), which is below
  // 3.5 slack / span for spans above 16 slack, and 3u of rounding. Of a shorter span nothing is known.
  double share = 0.5;
  double doubt = 0.5;
  if (span > 16 * slack) {
    share = std::clamp(a / (a - b), 0.0, 1.0);
    doubt = 4 * slack / span + 4 * kUnit;
  }
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = p[i] + share * (q[i] - p[i]);
    length = std::max(length, std::fabs(q[i] - p[i]));
  }
  // 1.01 for the rounding of the length and of the product.
  error = std::max(error, 1.01 * length * doubt + 2 * rounded_.vertex_error());
}

Interval overlap(const Chord& a, const Chord& b) {
  Double3 d{};
  double square = 0;
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = a.point[1][i] - a.point[0][i];
    square += d[i] * d[i];
    largest = std::max(largest, std::fabs(d[i]));
  }
  const double error = a.error + b.error;
  // A chord that is hardly longer than its error may be anywhere in the other one.
  if (largest < 100 * error || square == 0) return {0, 1};
  std::array<double, 2> t{};
  double far = 1;
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < 3; ++i) t[k] += d[i] * (b.point[k][i] - a.point[0][i]);
    t[k] /= square;
    far = std::max(far, std::fabs(t[k]));
  }
  // With L = largest and e = error: d is off by 2e in each coordinate, b - a by e, and |b - a| <= far * L in each. So
  // the numerator is off by 3 (2e far L + L e), the denominator, at least L^2, by 12 L e; together (18 far + 3) e / L,
  // and 24 far e / L with the terms of second order, as L > 100 e. Rounding: some ten operations, 1e-15 far.
  const double doubt = 24 * error / largest * far + 1e-12 * far;
  return {std::max(0.0, std::min(t[0], t[1]) - doubt), std::min(1.0, std::max(t[0], t[1]) + doubt)};
}

}  // namespace nef::minkowski

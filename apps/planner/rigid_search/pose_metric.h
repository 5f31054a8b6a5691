// SPDX-License-Identifier: Apache-2.0
//
// Distances and steps between poses in doubles, and reproducible random numbers, for searches.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/orientation/rotations.h"
#include "apps/planner/rigid/rigid_motion.h"

namespace nef::planner {

/// Random numbers that are the same everywhere (SplitMix64, Steele et al. 2014).
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  /// From 0 on, less than 1.
  double uniform() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
  /// From 0 to count - 1.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
  /// A rotation, evenly distributed: a point of a ball of integers, projected.
  Eigen::Quaterniond rotation() {
    while (true) {
      Eigen::Vector4d v;
      for (Eigen::Index k = 0; k < 4; ++k) v[k] = 2 * uniform() - 1;
      const double square = v.squaredNorm();
      if (square > 0x1p-6 && square <= 1) return Eigen::Quaterniond(v / std::sqrt(square));
    }
  }

 private:
  std::uint64_t state_;
};

/// How far poses are from each other: the way of the position, and the angle times the reach of the body.
class PoseMetric {
 public:
  /// Positions and rotations that it makes are multiples of small units, so that numbers stay short.
  explicit PoseMetric(double reach) : reach_(reach), unit_(std::exp2(std::ilogb(reach) - 24)) {}

  [[nodiscard]] double reach() const { return reach_; }

  /// The quaternion of length 1 in doubles.
  static Eigen::Quaterniond rounded(const Quaternion& q) {
    return Eigen::Quaterniond(nearest_double(q[0]), nearest_double(q[1]), nearest_double(q[2]), nearest_double(q[3]))
        .normalized();
  }
  [[nodiscard]] double distance(const Vector3d& a, const Eigen::Quaterniond& p, const Vector3d& b,
                                const Eigen::Quaterniond& q) const {
    const double cosine = std::fabs(p.dot(q));
    return (a - b).norm() + reach_ * 2 * std::sqrt(std::max(0.0, 2 - 2 * cosine));  // the chord, not the arc
  }
  [[nodiscard]] double distance(const RigidPose& a, const RigidPose& b) const {
    return distance(to_vector(a.position), rounded(a.quaternion), to_vector(b.position), rounded(b.quaternion));
  }
  /// A pose about this part of the way from one to the other.
  [[nodiscard]] RigidPose between(const RigidPose& a, const Vector3d& b, const Eigen::Quaterniond& q,
                                  double part) const {
    const Eigen::Quaterniond p = rounded(a.quaternion);
    const double sign = p.dot(q) < 0 ? -1 : 1;
    const Eigen::Vector4d mixed = (1 - part) * p.coeffs() + part * sign * q.coeffs();  // x, y, z, w
    constexpr unsigned kLevel = 7;
    return {exact(to_vector(a.position) + part * (b - to_vector(a.position))),
            rounded_to_grid({mixed[3], mixed[0], mixed[1], mixed[2]}, kLevel)};
  }
  /// A position as an exact point whose numbers are short.
  [[nodiscard]] Rational3 exact(const Vector3d& p) const {
    Rational3 result;
    for (std::size_t k = 0; k < 3; ++k) {
      result[k] = exact_rational(std::round(p[static_cast<Eigen::Index>(k)] / unit_) * unit_);
    }
    return result;
  }

 private:
  double reach_;
  double unit_;
};

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// Which boxes a ray may meet, in double precision.
#pragma once

#include "nef/geometry/predicates.h"
#include "nef/geometry/search/box_tree.h"

namespace nef {

/// Conservative test of boxes against a ray: never refuses a box that the ray meets.
class RayFilter {
 public:
  /// `origin` encloses the point where the ray begins; the direction is not zero.
  RayFilter(const Box& origin, const Direction& direction);

  /// The axis along which the ray moves fastest, and whether it goes up (+1) or down (-1) there.
  [[nodiscard]] std::size_t main_axis() const { return main_; }
  [[nodiscard]] int main_sign() const { return sign_[main_]; }

  /// Nothing behind the point in this box matters any more.
  void cut(const Box& point);

  [[nodiscard]] bool may_meet(const Box& box) const;

 private:
  [[nodiscard]] bool may_meet_projected(const Box& box, std::size_t i, std::size_t j) const;

  Box origin_;
  Box reach_;  // holds all of the ray that still matters
  std::array<double, 3> direction_{};
  std::array<int, 3> sign_{};
  std::size_t main_ = 0;
  bool axis_parallel_ = false;
};

}  // namespace nef

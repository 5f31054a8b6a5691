// SPDX-License-Identifier: Apache-2.0
//
// Moments of a solid of density one, exact; its principal axes, in doubles.
#pragma once

#include <array>
#include <optional>

#include "nef/forward.h"
#include "nef/number/number.h"

namespace nef {

/// The matrix of a quadratic form, or three axes as rows.
using Rational3x3 = std::array<Rational3, 3>;

/// Integrals over a set of finite volume. Lower-dimensional parts count for nothing.
struct Moments {
  Rational volume;
  Rational3 first;     ///< of x, y, z
  Rational3x3 second;  ///< of the products x x, x y, ...: symmetric

  /// The centre of mass; nothing if the volume is zero.
  [[nodiscard]] std::optional<Rational3> centroid() const;

  /// The inertia tensor about a point: the entries are the integrals of y y + z z, -x y, ... with coordinates taken
  /// from that point.
  [[nodiscard]] Rational3x3 inertia(const Rational3& about) const;
};

/// The moments of the set; nothing if it has infinite volume. O(n) rational operations.
std::optional<Moments> moments(const Polyhedron& a);

/// Principal moments of inertia about the centroid, smallest first, and the axes that belong to them: unit vectors, a
/// right-handed system, in this order. In doubles: eigenvalues within some units in the last place of the largest.
struct PrincipalInertia {
  std::array<double, 3> moments{};
  std::array<std::array<double, 3>, 3> axes{};
};

/// Throws InputError if the volume is zero.
PrincipalInertia principal_inertia(const Moments& moments);
/// The same of an inertia tensor in doubles.
PrincipalInertia principal_inertia(const std::array<std::array<double, 3>, 3>& tensor);

}  // namespace nef

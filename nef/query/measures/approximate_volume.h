// SPDX-License-Identifier: Apache-2.0
//
// Measures in double precision with proven bounds. The exact ones of a detailed set can take longer than making the
// set, and have millions of digits.
#pragma once

#include <array>
#include <optional>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/query/moments.h"

namespace nef {

/// A volume that is off by at most `error`.
struct MeasuredVolume {
  double value = 0;
  double error = 0;
};

/// The volume of a set (the exact one: nef::volume); infinite, with no error, if that is. O(n). The number does not
/// depend on that of the threads (0: as many as the machine has).
MeasuredVolume approximate_volume(const Polyhedron& a, const Monitor& monitor = {});
/// The same for the set that a complex stands for.
MeasuredVolume approximate_volume(const Complex& c, const Monitor& monitor = {});

/// An area that is off by at most `error`.
struct MeasuredArea {
  double value = 0;
  double error = 0;
};

/// The area of all facets of a set, each once; infinite, with no error, if one is unbounded. nef::surface_area, which
/// is off by some units in the last place only, takes longer than making a detailed set. O(n). The number does not
/// depend on that of the threads.
MeasuredArea approximate_area(const Polyhedron& a, const Monitor& monitor = {});

/// The centre of mass and the inertia tensor about it of a set of density one.
struct MeasuredMoments {
  std::array<double, 3> centroid{};
  double centroid_error = 0;  ///< each coordinate is off by at most this
  std::array<std::array<double, 3>, 3> inertia{};
  double inertia_error = 0;  ///< each entry is off by at most this
  /// Of the tensor given here. Each moment is off by 3 inertia_error, and some units in the last place of the largest.
  PrincipalInertia principal;
};

/// Nothing if the volume is infinite, or may be zero. O(n). The exact ones: nef::moments.
std::optional<MeasuredMoments> approximate_moments(const Polyhedron& a, const Monitor& monitor = {});

}  // namespace nef

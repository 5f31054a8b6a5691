// SPDX-License-Identifier: Apache-2.0
//
// Contacts of two solids that allow no motion at all.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "apps/minkowski/convolution/facets/covered_voxels.h"
#include "apps/minkowski/convolution/facets/near_origin.h"
#include "apps/minkowski/convolution/facets/solid_features.h"
#include "apps/minkowski/convolution/marks/sum_membership.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

namespace interlock {
struct Saddle;
}

/// The vertices around which neither a solid nor the rest of space is convex, for sums with any other one.
class Saddles {
 public:
  /// Keeps a copy of the solid, which is O(1). The solid has one wedge at each edge. O(n d^3) signs for vertices of
  /// degree d.
  Saddles(const Polyhedron& solid, const Monitor& monitor);

  [[nodiscard]] const Polyhedron& solid() const { return solid_; }
  [[nodiscard]] const std::vector<interlock::Saddle>& all() const { return *all_; }

 private:
  Polyhedron solid_;
  std::shared_ptr<const std::vector<interlock::Saddle>> all_;
};

/// Two solids A and x - B interlock if they touch so that each translation, however small, makes them overlap nearby,
/// or all but those of less than three dimensions do. No facet of the reduced convolution need tell of such a point x
/// of A + B that is not in int A + int B. It is the sum of a vertex of each, or an edge with more than one wedge has
/// part in it:
/// - at a facet of one of the two the translations away from it are free, and at edges that are not parallel those
///   away from the plane of both;
/// - at an edge and whatever else the translations are told by cones in the plane across it. Let one of them be a
///   single wedge. If it is convex, so it can be moved along itself; if its complement is, that can hold whatever
///   moves into it;
/// - in the same way a convex cone moves along itself, and what is in a convex hole can move along that, so both
///   vertices are saddles of their solids.
/// These are the sums of two saddles of which some directions into the solids do not tell that they overlap, nor that
/// the sum is in int A + int B: all points where A and x - B interlock, and others. Both solids have one wedge at each
/// edge. Points that surely are not in the ball `near` may be left out. O(n m) directions located on sphere maps for n
/// and m saddles.
struct SaddlePoint {
  Rational3 point;
  std::uint8_t mark = 0;  ///< both vertices belong to their sets
};
std::vector<SaddlePoint> saddle_points(const Saddles& a, const Saddles& b, const SumMembership& membership,
                                       const CoveredVoxels& covered, const Monitor& monitor,
                                       const NearOrigin& near = NearOrigin(HUGE_VAL));

}  // namespace nef::minkowski

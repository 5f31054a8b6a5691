// SPDX-License-Identifier: Apache-2.0
//
// Mathematical morphology [Serra 1982] and what else is made of Minkowski sums: erosion, opening, closing, offsets with
// certified balls, sweeps, hulls, penetration, no-fit sets, accessibility. Everything is exact; where the answer of a
// question is no polyhedron (an offset by a round ball), there are two that enclose it.
//
// Sets are any Nef polyhedra, open, closed or neither, unless a function says otherwise. `options` and `report` are
// those of the sums that are taken (see minkowski.h); times and counts add up over them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "apps/minkowski/minkowski.h"
#include "nef/distance/distance.h"
#include "nef/parts/split.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// A eroded by B: all x with x + B in A, which is the complement of complement(A) + -B. Everything if B is empty. For a
/// bounded A it costs what a sum of bounded sets does.
Polyhedron erode(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                 MinkowskiReport* report = nullptr);

/// (A eroded by B) + B: the union of all translates of B that lie in A. B must not be empty (InputError).
Polyhedron opening(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                   MinkowskiReport* report = nullptr);

/// (A + B) eroded by B: what no translate of -B reaches that misses A. Holds A. B must not be empty (InputError).
Polyhedron closing(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                   MinkowskiReport* report = nullptr);

/// On which side of an exact answer that is no polyhedron a polyhedron is.
enum class Side : std::uint8_t { kInner, kOuter };

/// A polyhedral ball about the origin, inside of the round one of its radius (vertices on the sphere) or around it.
struct BallApproximation {
  ConvexCell cell;
  Rational error;  ///< at least the greatest distance of a point of either surface to the other one
};

/// An octahedron whose edges are split into `splits` parts, every vertex put exactly onto the sphere (kInner), and
/// scaled by the least multiple of 2^-20 for which all facets are surely outside of it (kOuter): 4 splits^2 + 2
/// vertices, the error falls with the square of `splits`. Rational, symmetric under sign changes of coordinates. Throws
/// InputError unless radius > 0 and 1 <= splits <= 64.
BallApproximation ball_approximation(const Rational& radius, int splits, Side side, const Monitor& monitor = {});

/// Which of the two balls makes an offset by `radius` lie on a side of the exact one: eroding by more leaves less, so
/// the inner side of an erosion takes the outer ball.
constexpr Side ball_side(int sign_of_radius, Side side) {
  return (sign_of_radius > 0) == (side == Side::kInner) ? Side::kInner : Side::kOuter;
}

/// The inner one as a set: ball(r, n) of expressions. Throws InputError unless `splits` is a whole number from 1 to 64.
Polyhedron inner_ball(const Rational& radius, const Rational& splits, const Monitor& monitor = {});

/// A set that lies inside (kInner) or around (kOuter) the offset of A by a radius: A + a closed ball for radius > 0, A
/// eroded by one for radius < 0, A itself for 0. The true offset lies between the two, and both are within `error` (see
/// ball_approximation) of it in this sense: each is the offset with a ball whose radius is off by at most that.
Polyhedron offset(const Polyhedron& a, const Rational& radius, int splits, Side side,
                  const MinkowskiOptions& options = {}, MinkowskiReport* report = nullptr);

/// What A passes over as it moves along a polyline of at least one point: A + the polyline.
Polyhedron sweep(const Polyhedron& a, std::span<const Rational3> path, const MinkowskiOptions& options = {},
                 MinkowskiReport* report = nullptr);

/// The convex hull of a set, with its marks: the hull of an open set is open, that of a box without a corner lacks it,
/// that of a line and a point is an open strip and these two. O(n log n) expected for bounded closed sets, an
/// intersection for each face of the hull otherwise.
Polyhedron hull(const Polyhedron& a, const Monitor& monitor = {});

/// By how much the hull of a set exceeds it, if that is next to nothing: at most 10^-9 of the hull's volume, but not
/// zero. That is what a convex solid looks like whose coordinates were rounded; taking its hull instead, which holds
/// it, makes sums fast. Nothing for other sets. O(n log n) expected.
std::optional<Rational> excess_of_hull(const Polyhedron& a, const Monitor& monitor = {});

/// How two bounded sets stand to each other; their closures and interiors decide.
struct Penetration {
  using Kind = Contact;
  Kind kind = Kind::kDisjoint;
  /// The shortest translation of B (one of them) after which they touch: 0 if they do so already; the way out if they
  /// overlap, the way to contact if they are disjoint. Exact.
  Rational3 translation;
  Rational squared_length;
};

/// From the boundary of A + -B next to the origin: the nearest point of a facet's plane, an edge's line, or a vertex.
/// If the strategy is kAuto, only what of the convolution comes near the origin is looked at (nearest_outside), but for
/// a few kinds of sets; else the whole sum is made.
/// Throws InputError if one is empty, UnsupportedError if one is unbounded.
Penetration penetration(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                        MinkowskiReport* report = nullptr);

/// The no-fit set: all translations t for which A and B + t touch without overlap, (cl A + -cl B) \ (int A + -int B).
/// Facets, edges and points; slots that B fits exactly are among them.
Polyhedron no_fit_set(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                      MinkowskiReport* report = nullptr);

/// Where a tool can go, and what it can touch there.
struct Reach {
  Polyhedron positions;  ///< of the tool's reference point (the origin): connected free positions, closed
  Polyhedron touched;    ///< the part of the boundary of the part that the tool touches at one of them
  Polyhedron untouched;  ///< the rest of that boundary
};

/// The free positions of a translating tool outside of a part that are connected to infinity, or to `from`, and what of
/// the part's boundary the closed tool touches there. Contact is free, passages as wide as the tool are passages. Both
/// sets must be bounded (UnsupportedError). Throws InputError if the tool is empty or `from` is not free.
Reach reach(const Polyhedron& tool, const Polyhedron& part, const std::optional<Rational3>& from = std::nullopt,
            const MinkowskiOptions& options = {}, MinkowskiReport* report = nullptr);

/// How a milling tool comes to the part. It never turns.
enum class Approach : std::uint8_t {
  kAnywhere,  ///< from outside, along any path
  kFromAbove  ///< down the z axis: what is above the tool must be free, too (milling with 3 axes)
};

/// What a milling tool can make of a block of material with a part in it.
struct Millable {
  /// What is left where the tool has cut all that it can: closed, holds the part, and is the part wherever the tool
  /// reaches.
  Polyhedron shape;
  /// What that has beyond the part: closed solids, each connected inside, by descending volume.
  std::vector<Polyhedron> unreached;
};

/// The material that a tool can not remove from around a part without cutting into it: what no position of the tool
/// covers that is free (contact is) and, by free positions, connected to the outside; of a tool from above, no free
/// position above which all others are free. What is below the part is no obstacle, and not cut from below. Both
/// sets must be bounded (UnsupportedError), the tool must have an interior (InputError). The cost is that of a
/// configuration space and of a sum of what is free within the part's box with the tool.
Millable millable(const Polyhedron& part, const Polyhedron& tool, Approach approach = Approach::kAnywhere,
                  const MinkowskiOptions& options = {}, MinkowskiReport* report = nullptr);

using nef::component_of;  // nef/parts/split.h

}  // namespace nef::minkowski

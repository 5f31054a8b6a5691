// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums of any two Nef polyhedra, the vertical decomposition they are made from
// [Hachenberger 2009], and configuration spaces of translating robots. Open and closed sets, missing
// points, lower-dimensional parts: everything is exact, nothing is regularized.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/geometry/predicates.h"

namespace nef::minkowski {

/// How sums are made: how the sums of the pairs of cells are united, or without cells. The set is the same for each.
enum class UnionStrategy : std::uint8_t {
  kAuto,         ///< as kConvolution or kQueue, whichever is likely to be the faster
  kConvolution,  ///< no cells: the facets of the reduced convolution are arranged; for two bounded sets that lie in the
                 ///< closures of their interiors, or one such and any other if both are closed; others (and some rare
                 ///< ones of these) as for kQueue
  kQueue         ///< the sums of cells are united: many at once where few of their faces nearly coincide, and by the
                 ///< queue of [Hachenberger 2009] elsewhere, in bounded memory
};

/// All strategies, as the program spells them.
inline constexpr std::array<std::pair<std::string_view, UnionStrategy>, 3> kUnionStrategies{
    {{"auto", UnionStrategy::kAuto}, {"convolution", UnionStrategy::kConvolution}, {"queue", UnionStrategy::kQueue}}};

/// The phase of sums that monitors are told.
inline constexpr char kSumPhase[] = "Minkowski sum";

struct MinkowskiOptions {
  UnionStrategy strategy = UnionStrategy::kAuto;
  /// Who watches; what it refers to must outlive the call. It is told one phase (kSumPhase) after each pair of cells,
  /// and again and again while sums are united or a convolution is arranged, in thousandths of the work. What consists
  /// of several sums (an opening) counts anew for each.
  Monitor monitor = {};
};

/// How a sum was made, in words: a strategy by its name in the program, `none` if nothing had to be united, `planes`
/// for unbounded operands; and why that. With what each way has to do, where that was looked at.
struct StrategyChoice {
  std::string chosen;
  std::string why;
  std::size_t pairs_of_cells = 0;      ///< about as many: there is about one cell for each reflex edge, and one more
  std::size_t convolution_facets = 0;  ///< of the reduced convolution, without what surely lies inside
};

/// What was done, for people who measure.
struct MinkowskiReport {
  std::vector<StrategyChoice> choices;  ///< one for each sum: two of an opening
  std::size_t cells_a = 0;
  std::size_t cells_b = 0;
  std::size_t pairs = 0;
  std::size_t pairs_dropped = 0;          ///< sums that lie inside another one, found before the union
  std::size_t united_at_once = 0;         ///< sums that went into unions of many at once
  std::size_t united_two_by_two = 0;      ///< sums that went into unions of two sets
  std::size_t convolution_facets = 0;     ///< of the reduced convolution, if there was one
  std::size_t convolution_intervals = 0;  ///< parts of the meetings of its facets where the boundary may be
  std::size_t convolution_points = 0;     ///< points of it that were located exactly
  std::size_t convolution_regions = 0;    ///< regions and boundary items of which only an intersection could tell
  double seconds_decomposition = 0;
  double seconds_convex_sums = 0;
  double seconds_union = 0;
  double seconds_total = 0;
  PredicateCounts predicates_decomposition;
  PredicateCounts predicates_convex_sums;
  PredicateCounts predicates_union;
};

/// A + B = { a + b : a in A, b in B } for any two sets, exactly: open and closed parts, lower-dimensional parts,
/// cavities. Empty if one is empty. Cost: decompositions into k and l cells, k l convex sums and their union. If an
/// operand is unbounded, both are cut by whole planes through their reflex edges (see unbounded_sum.h), which is for
/// sets with few of these; throws UnsupportedError if there are too many.
Polyhedron minkowski_sum(const Polyhedron& a, const Polyhedron& b, const MinkowskiOptions& options = {},
                         MinkowskiReport* report = nullptr);

/// The vertical decomposition of a bounded set [Hachenberger 2009]: convex cells whose union is
/// exactly `a`. Walls stand along the coordinate axis that is likely to need the fewest cells. The cells of dimension 3
/// have disjoint interiors and cover the interior's closure; they carry the marks of their walls and sides. What marks
/// keep out of them (a selected part of a side that is not selected whole, an antenna) follows as cells of dimension 2,
/// 1, 0. A convex set is one cell. Throws UnsupportedError for an unbounded set.
std::vector<ConvexCell> decompose(const Polyhedron& a, const Monitor& monitor = {});

/// True if the set is convex (marks included: a closed box without one point of an edge is not).
/// O(n log n) for open and closed sets, O(n^2) for others; bounded sets only, others throw UnsupportedError.
bool is_convex(const Polyhedron& a, const Monitor& monitor = {});

/// The set of the points -x, x in a.
Polyhedron negate(const Polyhedron& a, const Monitor& monitor = {});

/// A closed set without its border. The border is the boundary of solid parts, the open edges of surfaces and the ends
/// of curves; a single point has none. Told locally, so that it has one meaning where parts of different dimension
/// meet:
///  - where all of the set is solid (the closure of its interior), every point of the boundary is border;
///  - elsewhere, at surfaces, curves, and where these end on anything, a point is border iff the set looks like a ball
///    with that point on its rim: its link (the set on a small sphere around the point) has one component and no
///    loop, i.e. the local homology vanishes. So folds and seams of surfaces, places where a surface or curve is
///    fixed to a solid or to another surface, and points where they merely touch are no border.
/// The result is the interior of the solid parts and all of the rest but its rims; it is dense in the set. Nothing but
/// marks changes. O(n). For an unbounded set, what happens at infinity is the trace of what goes there.
Polyhedron without_border(const Polyhedron& closed);

/// The free positions of the reference point (the origin) of a translating robot R among obstacles O_i:
///   B \ ( W + -inner(R) ),  W = the union of inner(O_i) and of inner(the union of the O_i), B = the box or all space.
/// inner(S) is S without its border: contact of borders is free; forbidden is where a point of the robot
/// that is not on its border meets such a point of an obstacle, or of a seam between obstacles. Where the robot is
/// solid this is "open robot against closed obstacles" and the free space is closed, so passages as narrow as the robot
/// remain as facets, edges and vertices; a robot that is a point, a segment or a facet may slide
/// on solid obstacles but not enter them, and not pass through a surface, a curve or a point but along their borders.
/// Robot and obstacles are taken closed. The reference point may lie outside the robot.
Polyhedron configuration_space(const Polyhedron& robot, std::span<const Polyhedron> obstacles,
                               const std::optional<std::array<Rational3, 2>>& box = std::nullopt,
                               const MinkowskiOptions& options = {}, MinkowskiReport* report = nullptr);

}  // namespace nef::minkowski

// SPDX-License-Identifier: Apache-2.0
//
// Sums that lack parts of their boundary: which items around a point belong to them.
#pragma once

#include <vector>

#include "apps/minkowski/convolution/arrangement/pyramid_drawer.h"
#include "apps/minkowski/convolution/marks/sum_membership.h"
#include "nef/base/monitor.h"

namespace nef::minkowski {

/// Let U = int A + int B, for A and B in the closures of their interiors. U is open, its closure is the sum of the
/// closures, and U lies in A + B. What is left to tell are the points of cl U \ U: those at which A touches x - B and
/// neither enters the other. They are of two kinds.
///
/// Items with something of the outside next to them are surely such. Such an item belongs to A + B iff it lies in a + b
/// for items a, b of A and B that belong to them; and then it lies on a facet of the convolution, in its inside, on a
/// side or at a corner according to the dimensions of a and b. So the marks of these are combined by "or".
///
/// Items all around which the inside of the sum is may be in U, or passages as narrow as they can be. Let x be a point
/// of the latter. At each contact of A with x - B, with cones K and L there, D = { v : int K does not meet v - int L }
/// is a closed cone other than all of space, and all of them have no inside in common. If D has an inside, convolution
/// facets cover its boundary, and D is in front of them; so if D has one of two neighbouring regions of the drawing,
/// and that is just behind the facet between them, it has the other one, too. Going from region to region from the back
/// of a facet to its front, one must therefore be able to end in more than one place; else that place would be in all
/// D. (If facets bound D from both sides, as in a slot, there is no such step.) Where that is so, the definition tells.
///
/// D without an inside: see interlock.h.
class BoundaryMarker {
 public:
  /// Pyramids and facets must outlive the object.
  BoundaryMarker(const FacetPyramids& pyramids, const ConvolutionFacets& facets, const Monitor& monitor)
      : pyramids_(pyramids), facets_(facets), monitor_(monitor) {}

  /// False if no item around a point can be a passage, going by the drawing around it alone.
  static bool may_have_passages(const SphereMapView& map);

  /// Gives all items but the regions, which are marked 0 or 1 already, their final marks instead of those of the
  /// drawing. Items of which only the definition can tell are put off until answer(); their maps must stay where they
  /// are.
  void mark(PointId point, bool is_saddle_point, SphereMapBuffer& map);

  /// Puts what is open to the definition, and tells of kSumPhase. Returns how many of these items are not in the sum.
  std::size_t answer(const SumMembership& membership);

  /// Points that were put to the definition.
  [[nodiscard]] std::size_t tested() const { return questions_.size(); }

 private:
  // Whether a point belongs to the sum, and what is marked so.
  struct Question {
    Rational3 point;
    LabelId* mark = nullptr;
    LabelId* twin = nullptr;  // of halves; else the same
  };
  void ask(const Rational3& point, LabelId& mark, LabelId& twin) { questions_.push_back({point, &mark, &twin}); }

  const FacetPyramids& pyramids_;
  const ConvolutionFacets& facets_;
  Monitor monitor_;
  std::vector<Question> questions_;
};

}  // namespace nef::minkowski

// SPDX-License-Identifier: Apache-2.0
//
// From candidate points to the sum: which regions around them are inside.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <variant>
#include <vector>

#include "apps/minkowski/cells/meeting_points.h"
#include "apps/minkowski/convolution/arrangement/pyramid_drawer.h"
#include "apps/minkowski/convolution/arrangement/surviving_intervals.h"
#include "apps/minkowski/convolution/marks/boundary_marker.h"
#include "apps/minkowski/convolution/marks/interlock.h"
#include "apps/minkowski/convolution/marks/sum_membership.h"
#include "nef/base/defect.h"
#include "nef/base/union_find.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// What came of an arrangement of facets, for people who measure.
struct ConvolutionCounts {
  std::size_t points = 0;  ///< located exactly
  std::size_t tested = 0;  ///< regions and boundary items that only an intersection could tell
};

/// Takes the points at which surviving intervals end, finds the regions around them, joins those that an interval
/// joins, and makes the sum. A region is inside if it is just behind a facet. Of others, a point on no facet is put to
/// the definition. If the sum need not be closed, so are places where it may be as narrow as it can be, and what cannot
/// be told by facets there.
class ConvolutionRegions {
 public:
  /// All must outlive the object; the facets' tables get more planes and points.
  ConvolutionRegions(ConvolutionFacets& facets, const RoundedFacets& rounded, const SurvivingIntervals& intervals,
                     const SumMembership& membership, unsigned threads);

  /// The sum; or a defect, which would be a bug. To be called once, with the saddle points of a sum that need not be
  /// closed. `poll` is called with the share that is done and may throw.
  std::variant<Complex, Defect> run(std::span<const SaddlePoint> saddles, const std::function<void(double)>& poll);

  [[nodiscard]] const ConvolutionCounts& counts() const { return counts_; }

 private:
  struct Vertex {
    PointId point{0};
    SphereMapBuffer map;             // sfaces are marked 1 if they are just behind a facet
    std::uint32_t first_region = 0;  // of its sfaces
    bool is_saddle_point = false;
  };

  void add_interval(const SurvivingInterval& interval);
  void add_points_of(const FacetSegment& s, const SegmentCut& cut);
  void add_points_beyond(std::uint32_t f, std::uint32_t g, const SegmentEnd& end);
  void add_points_near(const FacetSegment& s, const SegmentCut& cut, std::uint32_t facet);
  void add_meeting(std::uint32_t f, std::uint32_t g, std::uint32_t h);
  void add_corner(std::uint32_t corner);
  void add_point(PointId point);
  void draw_points();
  [[nodiscard]] std::uint32_t nearest(const FacetSegment& s, const SegmentCut& cut, bool last) const;
  void join(const FacetSegment& s, const Vertex& from, const Vertex& to);
  [[nodiscard]] std::uint32_t svertex_along(const Vertex& v, const FacetSegment& s, bool forward) const;
  void add_saddle_point(const SaddlePoint& saddle);
  void add_passages();
  void add_changes_of_marks();
  void add_crossings(std::uint32_t f, std::uint32_t g);
  [[nodiscard]] bool is_of_use(PointId point, SphereMapBuffer& map) const;
  void add_points(std::span<const SaddlePoint> saddles, const std::function<void(double)>& poll);
  void join_regions();
  [[nodiscard]] std::vector<std::uint8_t> find_inside(const std::function<void(double)>& poll);
  void mark_boundary(const std::vector<std::uint8_t>& inside, const std::function<void(double)>& poll);

  ConvolutionFacets& facets_;
  const SurvivingIntervals& intervals_;
  BoxTree tree_;
  FacetPyramids pyramids_;
  const SumMembership& membership_;
  unsigned threads_;
  BoundaryMarker marker_;
  bool is_closed_;
  bool among_passages_ = false;  // the points at hand are not ends of surviving intervals
  std::vector<Vertex> vertices_;
  MeetingPoints meetings_;
  struct KnownPoint {
    std::uint32_t vertex = kNone;       // kNone if all is inside there
    std::vector<std::uint32_t> facets;  // that hold it, in ascending order
  };
  std::unordered_map<std::uint32_t, KnownPoint> known_;  // point -> what is there
  struct Undrawn {
    PointId point{0};
    std::vector<FacetAtPoint> facets;
  };
  std::vector<Undrawn> undrawn_;     // points, known already, that may be vertices
  std::vector<std::uint32_t> near_;  // points at the cut at hand
  struct Joint {
    std::uint32_t segment = 0, from = 0, to = 0;  // points
  };
  std::vector<Joint> joints_;
  UnionFind regions_{0};
  ConvolutionCounts counts_;
};

}  // namespace nef::minkowski

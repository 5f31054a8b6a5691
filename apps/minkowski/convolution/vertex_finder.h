// SPDX-License-Identifier: Apache-2.0
//
// The points at which a run of surviving intervals ends.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "apps/minkowski/cells/meeting_points.h"
#include "apps/minkowski/convolution/arrangement/surviving_intervals.h"
#include "apps/minkowski/convolution/known_places.h"
#include "apps/minkowski/convolution/marks/interlock.h"
#include "apps/minkowski/convolution/point_drawer.h"
#include "nef/geometry/search/box_tree.h"

namespace nef::minkowski {

/// What the arrangement of a sum is asked: all is known, and may be shared between threads.
struct FacetArrangement {
  const ConvolutionFacets& facets;
  const RoundedFacets& rounded;
  const BoxTree& tree;  ///< over the boxes of the facets
  const FacetPyramids& pyramids;
  const SharedSides& at_side;
  const SurvivingIntervals& intervals;
  const SumMembership& membership;
};

/// Two vertices at the ends of a part of a segment that nothing cuts.
struct RegionJoint {
  std::uint32_t segment = 0;
  std::uint32_t from = 0, to = 0;  ///< vertices
};

/// What intervals end at.
struct FoundVertices {
  PointTable points;  ///< that were located exactly
  std::vector<RegionVertex> vertices;
  std::vector<RegionJoint> joints;
  std::size_t located = 0;  ///< points
};

/// Finds points and draws what is around them, each once. Keeps what it has found to spare work for what comes next, so
/// intervals near each other are best given one after the other. Not to be shared between threads.
class VertexFinder {
 public:
  /// The arrangement must outlive the object. Draws on the threads of the monitor.
  VertexFinder(const FacetArrangement& arrangement, const Monitor& monitor);
  VertexFinder(const VertexFinder&) = delete;
  VertexFinder& operator=(const VertexFinder&) = delete;
  ~VertexFinder() = default;

  /// The intervals of this range of numbers. Tells of kSumPhase.
  void add_intervals(std::size_t first, std::size_t last);

  /// For sums that need not be closed, when all intervals are there: saddle points and places where facets are not in
  /// general position.
  void add_passages(std::span<const SaddlePoint> saddles);

  /// What was found; to be called once.
  FoundVertices finish();

 private:
  void add_interval(const SurvivingInterval& interval);
  void add_points_of(const FacetSegment& s, const SegmentCut& cut);
  [[nodiscard]] std::array<bool, 2> goes_on_from(const FacetAtPoint& f, const FacetAtPoint& g,
                                                 const FacetSegment& s) const;
  [[nodiscard]] std::uint32_t only_point_of(const FacetSegment& s, const SegmentCut& cut) const;
  [[nodiscard]] bool is_only_point(std::uint32_t point, const FacetSegment& s, const SegmentCut& cut) const;
  void add_points_beyond(const FacetSegment& s, const SegmentEnd& end);
  void look_for_points_of(const FacetSegment& s, const SegmentCut& cut, double beyond);
  void add_known_line(const FacetSegment& s, const SegmentCut& cut);
  void add_points_of_line(const FacetSegment& s, const SegmentCut& cut, KnownLine& line);
  std::vector<std::uint32_t> facets_along(const FacetSegment& s, std::span<const std::uint32_t> facets);
  void add_points_near(const FacetSegment& s, const Box& box, std::uint32_t facet);
  void add_meeting(const FacetSegment& s, std::uint32_t h);
  [[nodiscard]] std::uint32_t known_meeting(const FacetSegment& s, std::uint32_t h) const;
  void add_meeting_of(const std::array<PlaneId, 3>& planes);
  void add_corner(std::uint32_t corner);
  void add_point(PointId point);
  void draw_points();
  [[nodiscard]] std::uint32_t nearest(const FacetSegment& s, const SegmentCut& cut, bool last) const;
  void add_saddle_point(const SaddlePoint& saddle);
  void add_doubtful_places();
  void add_changes_of_marks();
  void add_crossings(std::uint32_t f, std::uint32_t g);

  [[nodiscard]] const KnownPoint* find_known(std::uint32_t point) const {
    return point < number_.size() && number_[point] != kNone ? &known_[number_[point]] : nullptr;
  }
  [[nodiscard]] KnownPoint& known(std::uint32_t point) { return known_[number_[point]]; }
  [[nodiscard]] const KnownPoint& known(std::uint32_t point) const { return known_[number_[point]]; }

  const FacetArrangement& in_;
  Monitor monitor_;
  bool is_mixed_;                // not all of the sum's boundary has the same marks
  bool among_passages_ = false;  // the points at hand are not ends of surviving intervals
  FoundVertices result_;         // its joints come last
  MeetingPoints meetings_;
  std::unordered_map<std::uint32_t, std::uint32_t> corners_;  // of facets -> points
  std::vector<KnownPoint> known_;
  std::vector<std::uint32_t> number_;  // point -> in `known_`, or kNone
  PlacesOfPoints places_;              // of the known points
  KnownLines known_lines_;
  std::vector<PointId> undrawn_;      // points, known already, that may be vertices
  std::vector<std::uint32_t> near_;   // points at the cut at hand
  std::vector<std::uint32_t> asked_;  // per plane: the last cut where its meeting with the segment was asked for
  std::uint32_t cut_ = 0;             // the number of the cut at hand
  std::vector<RegionJoint> joints_;   // of points instead of vertices
};

}  // namespace nef::minkowski

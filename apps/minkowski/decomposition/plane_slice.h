// SPDX-License-Identifier: Apache-2.0
//
// The cut of a complex with an upright plane: what a wall in that plane may be bounded by.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/geometry/search/box_tree.h"

namespace nef::minkowski {

/// A plane that contains the direction of axis h, with coordinates (u, h); the third coordinate
/// follows from u.
struct SliceFrame {
  std::size_t u = 0, h = 2;
  Rational3 origin;  ///< a point of the plane
  Rational slope;    ///< change of the third coordinate per unit of u

  [[nodiscard]] std::size_t w() const { return 3 - u - h; }
  [[nodiscard]] Rational3 lift(const std::array<Rational, 2>& p) const;
  /// Zero on the plane.
  [[nodiscard]] Rational form(const Rational3& p) const;
};

/// A segment in a slice, from left to right (u[0] < u[1]), with nearest doubles.
struct SliceSegment {
  std::array<Rational, 2> u, h;
  std::array<double, 2> du, dh;

  [[nodiscard]] Rational height(const Rational& at) const { return h[0] + (h[1] - h[0]) * (at - u[0]) / (u[1] - u[0]); }
};

SliceSegment make_slice_segment(const std::array<Rational, 2>& left, const std::array<Rational, 2>& right);

/// The sign of a.height(at) - b.height(at); a filter in doubles first.
int compare_heights(const SliceSegment& a, const SliceSegment& b, const Rational& at, double at_double);

/// A segment parallel to axis h.
struct SliceUpright {
  Rational u, low, high;
};

/// Cuts one complex, which must not change and must outlive it, with many planes.
class PlaneSlicer {
 public:
  PlaneSlicer(const Complex& complex, const Monitor& monitor);

  /// Begins a new slice.
  void begin(const SliceFrame& frame);
  /// Adds the cut with all facets and isolated edges whose boxes overlap `query`.
  void add_overlapping(const Box& query);
  /// Adds the cut with one facet. O(size of the facet); more for facets that are not convex.
  void add_facet(FacetId facet);

  [[nodiscard]] const std::vector<SliceSegment>& segments() const { return segments_; }
  [[nodiscard]] const std::vector<SliceUpright>& uprights() const { return uprights_; }

  /// The exact coordinates of a vertex; computed once.
  const Rational3& point(VertexId vertex);
  [[nodiscard]] const Box& facet_box(FacetId facet) const { return facet_boxes_[facet.index()]; }

 private:
  int side(VertexId vertex);
  std::array<Rational, 2> flat(VertexId vertex);
  std::array<Rational, 2> crossing(VertexId a, VertexId b);
  void add_segment(const std::array<Rational, 2>& p, const std::array<Rational, 2>& q);
  void add_isolated_edge(HalfedgeId halfedge);
  bool holds(FacetId facet, const std::array<Rational, 2>& p);
  bool convex(FacetId facet);

  const Complex& complex_;
  Monitor monitor_;
  std::vector<Box> facet_boxes_;
  BoxTree facets_;
  IndexedVector<FacetId, std::int8_t> convex_;  // per facet: 1 yes, 0 no, -1 not asked yet
  std::vector<HalfedgeId> isolated_edges_;      // halfedges without facets
  IndexedVector<VertexId, Rational3> points_;
  IndexedVector<VertexId, std::uint8_t> known_;

  SliceFrame frame_;
  PlaneTable planes_;
  PlaneId plane_;
  std::uint32_t slice_ = 0;
  IndexedVector<VertexId, std::uint32_t> side_slice_;  // the slice that side_ belongs to
  IndexedVector<VertexId, std::int8_t> side_;
  std::vector<SliceSegment> segments_;
  std::vector<SliceUpright> uprights_;
};

}  // namespace nef::minkowski

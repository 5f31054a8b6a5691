// SPDX-License-Identifier: Apache-2.0
//
// Exact triangulation of a polygon with holes by a plane sweep.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "nef/mesh/polygon/ordered_blocks.h"
#include "nef/mesh/polygon/projected_corners.h"

namespace nef {

/// Triangulates polygons by the sweep of [Hertel, Mehlhorn 1983]: a line moves over the polygon, and each interval in
/// which the polygon meets it has a chain of corners behind it, from the left end of the edge below to that of the edge
/// above, up to which all is cut. A corner that the line reaches in the interval, or at one of its ends, is joined to
/// the corners of the chain that it sees. Keeps its memory from polygon to polygon.
class SweepTriangulator {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// Cuts a polygon whose corners are given ring after ring, each ending before the corner ring_end says; rings and
  /// requirements as for Triangulator. Triangles are between the points of the corners, turn counterclockwise and are
  /// appended to `out`. Each of them is asked whether it does turn so, and every side of one is a side of the polygon
  /// or of another one, turned round: what is appended covers each point as often as the rings go around it.
  ///
  /// Returns false if the rings are no such polygon; what has been appended then is worth nothing. O(n log n)
  /// for n corners: the runs of rings to the right and to the left are merged, corners at which intervals begin or part
  /// look for their place among the intervals, and everything else takes O(1) a triangle.
  bool triangulate(const ProjectedCorners& corners, std::span<const std::uint32_t> ring_end,
                   std::vector<Triangle>& out);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  struct Links {
    std::uint32_t prev = 0;
    std::uint32_t next = 0;
    std::uint32_t rank = 0;
    std::uint32_t above = kNone;  // the interval above the edge that leaves to the right
    std::uint32_t below = kNone;  // the interval below the edge that arrives from the right
  };
  // A list of corners that other lists may share the end of.
  struct Cell {
    std::uint32_t corner = 0;
    std::uint32_t rest = kNone;
  };
  // Both parts of the chain begin with the last corner that was reached.
  struct Interval {
    std::uint32_t floor = 0;      // the left end of the edge below
    std::uint32_t ceiling = 0;    // and of the edge above
    std::uint32_t lower = kNone;  // cells, down to the left end of the edge below
    std::uint32_t upper = kNone;  // up to that of the edge above
  };
  // An edge as it leaves a point or arrives there.
  struct Arm {
    std::uint32_t far = 0;  // the corner at the other end
    bool leaves = false;
  };
  enum class Kind : std::uint8_t { kEnd, kMerge, kFloor, kCeiling, kSplit, kStart, kAlone };

  void link(std::span<const std::uint32_t> ring_end);
  void sort(std::span<const std::uint32_t> ring_end);
  void collect_runs(std::span<const std::uint32_t> ring_end);
  template <typename Before>
  void merge_runs(Before before);
  bool reach(std::size_t first, std::size_t last);
  bool reach_together(std::span<const std::uint32_t> corners);
  void separate(std::span<const std::uint32_t> corners);
  [[nodiscard]] bool clockwise_before(std::uint32_t at, std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] Kind kind_of(std::uint32_t corner) const;
  bool handle(std::uint32_t corner, Kind kind);
  bool end(std::uint32_t p);
  bool merge(std::uint32_t p);
  bool go_on_below(std::uint32_t p);
  bool go_on_above(std::uint32_t p);
  bool split(std::uint32_t p, Kind kind);
  bool start(std::uint32_t p);
  [[nodiscard]] OrderedBlocks::Place find(std::uint32_t p);

  bool fan_lower(const Interval& interval, std::uint32_t p);
  bool fan_upper(const Interval& interval, std::uint32_t p);
  [[nodiscard]] std::uint32_t cut_lower(const Interval& interval, std::uint32_t p);
  [[nodiscard]] std::uint32_t cut_upper(const Interval& interval, std::uint32_t p);
  std::uint32_t push(std::uint32_t corner, std::uint32_t rest);
  std::uint32_t new_interval();
  bool add(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void add_known(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  const ProjectedCorners* corners_ = nullptr;
  std::vector<Triangle>* out_ = nullptr;
  std::vector<Links> links_;
  std::vector<ProjectedCorners::Corner> sorted_;  // runs in order, which become one
  std::vector<ProjectedCorners::Corner> merged_;
  std::vector<std::uint32_t> run_end_;
  std::vector<std::uint32_t> here_;  // corners at one point
  std::vector<Cell> cells_;
  std::uint32_t cell_count_ = 0;
  std::vector<Interval> intervals_;
  std::vector<std::uint32_t> free_intervals_;
  OrderedBlocks status_;
  bool broken_ = false;  // an answer that no such polygon gives
  std::vector<Arm> arms_;
};

}  // namespace nef

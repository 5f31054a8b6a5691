// SPDX-License-Identifier: Apache-2.0
//
// The exact half of a union of convex solids: from candidate points to the vertices of a complex.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "apps/minkowski/cells/exact_cells.h"
#include "apps/minkowski/cells/meeting_points.h"
#include "nef/base/monitor.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/sphere_map/overlay.h"
#include "nef/synthesis/complex_builder.h"

namespace nef::minkowski {

/// Collects the vertices of a union. Each candidate is located in all cells around it; one that no
/// cell has inside gets the overlay of the local pyramids of the cells that it touches.
class UnionVertices {
 public:
  /// Cells, rounded cells and boxes must outlive the object.
  UnionVertices(std::span<const ConvexCell> cells, const RoundedCells& rounded, const BoxTree& boxes,
                const Monitor& monitor);

  ExactCells& exact() { return exact_; }

  /// A candidate: a vertex of a cell. Returns a name of the point for is_on.
  std::uint32_t add_vertex(std::uint32_t cell, std::uint32_t vertex);
  /// True if a candidate is known to lie on a face; `name` may be kNone.
  [[nodiscard]] bool is_on(std::uint32_t name, std::uint32_t face) const;
  /// A candidate: where the planes of three faces meet, if they do in one point. Whether the faces
  /// reach that point is found out here. A good guess of the point saves time if it is known already.
  void add_meeting(std::uint32_t f, std::uint32_t g, std::uint32_t h, const Double3& guess);

  /// How much has been done, in evaluations of a plane's form in doubles (some nanoseconds each).
  [[nodiscard]] std::uint64_t work() const { return work_ + 200 * exact_.doubtful(); }

  /// The union. To be called once.
  Complex finish();

 private:
  void add_point(PointId point);
  [[nodiscard]] std::uint64_t grid_cell(const Double3& x) const;
  void drop_covered(std::vector<CellLocation>& touched);

  std::span<const ConvexCell> cells_;
  const RoundedCells& rounded_;
  const BoxTree& boxes_;
  Monitor monitor_;
  ExactCells exact_;
  MeetingPoints meetings_{exact_.planes, exact_.points};
  std::unordered_set<std::uint32_t> located_;                               // vertices of cells among them
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> faces_at_;  // of candidates that are left
  std::unordered_multimap<std::uint64_t, std::uint32_t> near_;              // grid cell -> such a candidate
  SphereOverlay overlay_;
  LabelFunction or_;
  CellLocation location_;
  std::array<SphereMapBuffer, 3> maps_;
  ComplexBuilder result_;
  std::uint64_t work_ = 0;
};

}  // namespace nef::minkowski

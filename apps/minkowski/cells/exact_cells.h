// SPDX-License-Identifier: Apache-2.0
//
// Solid convex cells with exact planes and points, made only for those that somebody asks about.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/cells/rounded_cells.h"
#include "nef/base/monitor.h"
#include "nef/geometry/plane_finder.h"
#include "nef/geometry/predicates.h"
#include "nef/sphere_map/arrangement.h"

namespace nef::minkowski {

/// Where a point lies in a closed convex solid.
struct CellLocation {
  enum class Kind : std::uint8_t { kOutside, kBoundary, kInside };
  Kind kind = Kind::kOutside;
  std::vector<std::uint32_t> faces;  ///< on the boundary: all faces that hold the point, in ascending order
};

/// Exact answers about cells; the rounded ones are asked first. Faces and vertices by their global
/// numbers in the rounded cells. Not to be shared between threads.
class ExactCells {
 public:
  /// Cells and rounded cells must outlive the object.
  ExactCells(std::span<const ConvexCell> cells, const RoundedCells& rounded, const Monitor& monitor);

  /// The plane of a face, its positive side outside.
  PlaneId plane(std::uint32_t face);
  /// The same if somebody asked for it before, or an invalid one.
  [[nodiscard]] PlaneId known_plane(std::uint32_t face) const { return plane_[face]; }
  /// The corners of a face, as vertices of its cell.
  [[nodiscard]] std::span<const std::uint32_t> corners(std::uint32_t face) const {
    return cells_[rounded_.cell_of_face(face)].mesh.face(local(face));
  }
  PointId point(std::uint32_t cell, std::uint32_t vertex);
  /// The side of a face on which a vertex of some cell lies: +1 outside.
  int side(std::uint32_t face, std::uint32_t cell, std::uint32_t vertex);
  /// The location of a point of `points` that is within 2^-51 relative of its doubles.
  void locate(std::uint32_t cell, PointId point, CellLocation& result);

  /// How many signs could not be told by the rounded cells, so far.
  [[nodiscard]] std::uint64_t doubtful() const { return doubtful_; }

  /// The local pyramid of the cell at a point on its boundary: labels 1 in the cell, 0 elsewhere.
  void pyramid(const CellLocation& at, SphereMapBuffer& out);

  /// Planes asked for so far, and points of vertices and of callers.
  PlaneTable planes;
  PointTable points;

 private:
  [[nodiscard]] std::uint32_t local(std::uint32_t face) const {
    return face - rounded_.first_face(rounded_.cell_of_face(face));
  }
  void draw_edge(const ConvexCell& cell, std::uint32_t f, std::uint32_t g);
  void draw_vertex(const ConvexCell& cell, std::span<const std::uint32_t> faces);

  std::span<const ConvexCell> cells_;
  const RoundedCells& rounded_;
  std::vector<PlaneId> plane_;           // per face, invalid until asked for
  std::vector<std::uint32_t> point_of_;  // per vertex, kNone until asked for
  Monitor monitor_;
  Arrangement drawing_;
  PlaneFinder finder_;
  std::uint64_t doubtful_ = 0;
};

}  // namespace nef::minkowski

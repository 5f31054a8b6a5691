// SPDX-License-Identifier: Apache-2.0
//
// The normal diagram (Gaussian map) of a convex solid: vertex i of the solid is a convex region of
// the sphere, the directions in which i is extreme; an edge is an arc between the normals of its
// two facets. It is held implicitly, as the adjacencies of the solid with exact directions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/convex/convex_cell.h"
#include "nef/geometry/predicates.h"

namespace nef::minkowski {

/// Adjacencies and directions of a convex cell of dimension 3. Corner c is the directed edge from
/// vertex source(c) to source(next(c)), with its face to the left.
class NormalDiagram {
 public:
  /// Keeps a reference to the cell, which must outlive it. O(n) and about a microsecond an item.
  explicit NormalDiagram(const ConvexCell& cell);

  [[nodiscard]] const ConvexCell& cell() const { return *cell_; }
  [[nodiscard]] std::size_t vertex_count() const { return cell_->mesh.vertices.size(); }
  [[nodiscard]] std::size_t face_count() const { return cell_->mesh.face_count(); }
  [[nodiscard]] std::size_t corner_count() const { return cell_->mesh.corners.size(); }

  [[nodiscard]] std::uint32_t source(std::uint32_t corner) const { return cell_->mesh.corners[corner]; }
  [[nodiscard]] std::uint32_t target(std::uint32_t corner) const { return source(twin_[corner]); }
  [[nodiscard]] std::uint32_t next(std::uint32_t corner) const { return next_[corner]; }
  [[nodiscard]] std::uint32_t twin(std::uint32_t corner) const { return twin_[corner]; }
  [[nodiscard]] std::uint32_t face(std::uint32_t corner) const { return face_[corner]; }
  /// A corner that starts at the vertex; the others follow by next_around.
  [[nodiscard]] std::uint32_t corner_at(std::uint32_t vertex) const { return corner_at_[vertex]; }
  [[nodiscard]] std::uint32_t next_around(std::uint32_t corner) const { return next_[twin_[corner]]; }

  /// The outward normal of a face.
  [[nodiscard]] const Direction& normal(std::uint32_t face) const { return normals_[face]; }
  /// The direction of a corner's edge up to its sign, which is sign_of(corner).
  [[nodiscard]] const Direction& line(std::uint32_t corner) const { return lines_[line_[corner]]; }
  [[nodiscard]] int sign_of(std::uint32_t corner) const { return corner < twin_[corner] ? 1 : -1; }

  /// sign(edge . n)
  [[nodiscard]] int sign_along(std::uint32_t corner, const Direction& n, const Monitor& monitor) const {
    return sign_of(corner) * sign_of_dot(line(corner), n, monitor);
  }

  /// A vertex that is extreme in direction n, found by climbing from `start`.
  [[nodiscard]] std::uint32_t extreme_vertex(const Direction& n, std::uint32_t start, const Monitor& monitor) const;

  /// What is extreme in direction n.
  struct Extreme {
    int dimension = 0;         ///< 0: the vertex; 1: the edge of `corner`; 2: the face of `corner`
    std::uint32_t vertex = 0;  ///< a vertex of it
    std::uint32_t corner = 0;
  };
  [[nodiscard]] Extreme extreme(const Direction& n, std::uint32_t start, const Monitor& monitor) const;

 private:
  void connect();
  void set_directions();

  const ConvexCell* cell_;
  std::vector<std::uint32_t> next_, twin_, face_, corner_at_, line_;
  std::vector<Direction> normals_, lines_;
};

/// The sum of two solids whose diagrams are at hand already (see convex_sum for cells).
ConvexCell convex_sum(const NormalDiagram& c, const NormalDiagram& d, const Monitor& monitor);

}  // namespace nef::minkowski

// SPDX-License-Identifier: Apache-2.0
//
// A body as convex pieces in a tree of boxes: what motions are checked with.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/oriented_box.h"
#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/mesh/mesh.h"

namespace nef::planner {

/// Convex pieces whose union is the body. Immutable, and safe to share between threads.
class RigidBody {
 public:
  /// A convex polytope, or a convex polygon, segment or point in space.
  struct Piece {
    Mesh mesh;                      ///< exact; one face for a polygon, none for a segment or a point
    std::vector<Vector3d> points;   ///< the vertices, each coordinate rounded to the nearest double
    std::vector<Vector3d> normals;  ///< of each face, outward, of length 1, each coordinate within 2^-51
    bool flat = false;              ///< no inside: part of a surface, or thinner
    double reach = 0;               ///< no |x| + |y| + |z| of a vertex is larger
    double diameter = 0;            ///< no two vertices are farther apart
  };
  /// A node of the tree: the box holds its pieces. Node 0 is the root.
  struct Node {
    OrientedBox box;
    double reach = 0;         ///< no |x| + |y| + |z| of a point of the box is larger
    double radius = 0;        ///< half the diagonal of the box
    std::uint32_t first = 0;  ///< the first of two children, or the piece of a leaf
    bool leaf = true;
  };

  /// The pieces of the closure of a bounded set: the cells of the vertical decomposition of its solid part, and flat
  /// ones of what sticks out of that. Throws InputError if the set is empty or unbounded.
  static RigidBody of_set(const Polyhedron& set, const Monitor& monitor = {});

  /// The faces of a mesh, each as a flat piece: a triangle soup that need not be closed. Faces must be planar and
  /// convex; triangles always are. Throws InputError if there are none.
  static RigidBody of_surface(const Mesh& mesh);

  /// All pieces of both bodies.
  static RigidBody together(std::span<const RigidBody> bodies);

  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

 private:
  explicit RigidBody(std::vector<Piece> pieces);
  void build(std::uint32_t node, std::span<std::uint32_t> members);
  void split(std::uint32_t node, std::span<std::uint32_t> members);

  std::vector<Piece> pieces_;
  std::vector<Node> nodes_;
};

}  // namespace nef::planner

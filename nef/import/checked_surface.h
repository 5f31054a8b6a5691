// SPDX-License-Identifier: Apache-2.0
//
// The second step from a mesh to a solid: mesh -> checked surface -> solid.
#pragma once

#include <cstddef>
#include <memory>

#include "nef/base/monitor.h"
#include "nef/mesh/mesh.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {

/// The surface of a mesh that was looked at: solids are made of nothing else. Its faces name vertices that exist and
/// have areas (those without area are known, and left out later), its edges are run through equally often in both
/// directions, and no two faces cross or overlap. What is left to find out is how its components lie to each other.
class CheckedSurface {
 public:
  /// How much is looked at.
  enum class Extent {
    kAll,          ///< everything
    kNoCrossings,  ///< all but faces that meet otherwise than in common vertices and edges: the caller knows of none
  };

  /// Throws InputError with the first problem that no solid has. The mesh must outlive this object. O(n log n) for
  /// meshes whose faces meet few others.
  CheckedSurface(const Mesh& mesh, Extent extent, const Monitor& monitor);

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] const MeshSurface& surface() const { return *surface_; }

  /// Faces meet otherwise than in common vertices and edges, or would without the faces that have no area.
  [[nodiscard]] bool in_contact() const { return in_contact_; }

  /// The volume is negative: the faces are clockwise as seen from outside.
  [[nodiscard]] bool inside_out() const { return inside_out_; }

  [[nodiscard]] std::size_t faces_without_area() const { return faces_without_area_; }

  /// Gives the memory of the surface back, which is as large as what is made of it.
  void release() { surface_.reset(); }

 private:
  const Mesh* mesh_;
  std::unique_ptr<const MeshSurface> surface_;
  bool in_contact_ = false;
  bool inside_out_ = false;
  std::size_t faces_without_area_ = 0;
};

}  // namespace nef

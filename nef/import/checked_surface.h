// SPDX-License-Identifier: Apache-2.0
//
// The second step from a mesh to a solid: mesh -> checked surface -> solid.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/construct/crossings.h"
#include "nef/mesh/mesh.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/surface_contacts.h"

namespace nef {

/// What a message about a mesh that crosses itself ends with: the rule that takes it.
std::string advice_to_unite();

/// The surface of a mesh that was looked at: solids are made of nothing else. Its faces name vertices that exist and
/// have areas (those without area are known, and left out later), its edges are run through equally often in both
/// directions (by Crossings::kOdd an even number of times, by kOutside in any way), and no two faces cross or overlap
/// unless a rule says what becomes of them. What is left to find out is how its components lie to each other.
class CheckedSurface {
 public:
  /// How much is looked at.
  enum class Extent {
    kAll,          ///< everything
    kNoCrossings,  ///< all but faces that meet otherwise than in common vertices and edges: the caller knows of none
  };

  /// Throws InputError with the first problem that the rule has no answer to; where another rule has one, the message
  /// says so. The mesh must outlive this object. O(n log n) for meshes whose faces meet few others.
  CheckedSurface(const Mesh& mesh, Extent extent, Crossings rule, const Monitor& monitor);

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  [[nodiscard]] const MeshSurface& surface() const { return *surface_; }

  /// Faces meet otherwise than in common vertices and edges, or would without the faces that have no area, or solids
  /// that share an edge do not lie beside each other.
  [[nodiscard]] bool in_contact() const { return in_contact_; }

  /// How faces meet otherwise than in common vertices and edges, unless that was not looked at.
  [[nodiscard]] std::span<const FaceContact> contacts() const { return contacts_; }

  /// The volume is negative: the faces are clockwise as seen from outside.
  [[nodiscard]] bool inside_out() const { return inside_out_; }

  [[nodiscard]] std::size_t faces_without_area() const { return faces_without_area_; }

  /// Gives the memory of the surface back, which is as large as what is made of it.
  void release() { surface_.reset(); }

 private:
  const Mesh* mesh_;
  std::unique_ptr<const MeshSurface> surface_;
  std::vector<FaceContact> contacts_;
  bool in_contact_ = false;
  bool inside_out_ = false;
  std::size_t faces_without_area_ = 0;
};

}  // namespace nef

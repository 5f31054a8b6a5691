// SPDX-License-Identifier: Apache-2.0
//
// The faces of a mesh with exact planes, as complexes are built from them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "nef/construct/construct.h"
#include "nef/construct/solid.h"
#include "nef/import/checked_surface.h"
#include "nef/mesh/surface/mesh_surface.h"

namespace nef {

/// The note about a mesh whose faces enclosed a negative volume.
inline constexpr const char* kTurnedOver = "all faces were oriented inward and were flipped";

/// Finds the plane of every face (faces that are not planar are triangulated, which is noted, or refused if the options
/// are strict) and builds complexes from any selection of faces. Faces without area are left out.
class MeshFaces {
 public:
  /// All arguments must outlive this object; `messages` may be null. All faces must be good or without area.
  MeshFaces(const Mesh& mesh, const MeshSurface& surface, const MeshOptions& options, Messages* messages);

  /// The union of the faces as a two-dimensional set. They must meet in common vertices and edges only. O(n log n).
  Complex surface(std::span<const std::uint32_t> faces);

  /// The same with marks that tell how the faces are turned (make_oriented_surface).
  Complex oriented_surface(std::span<const std::uint32_t> faces);

  /// The same of all faces.
  Complex oriented_surface() { return oriented_surface({}); }

  friend SolidFaces solid_faces(const CheckedSurface& checked, const MeshOptions& options, Messages* messages);

 private:
  SolidFaces collect(std::span<const std::uint32_t> faces);  // all if empty
  [[nodiscard]] std::vector<std::uint32_t> places_of(std::span<const std::uint32_t> faces) const;
  void add_points(std::span<const std::uint32_t> places);
  PointId push_small_point(const std::array<std::int64_t, 3>& x);
  [[nodiscard]] std::vector<std::uint32_t> in_order_of_points(std::span<const std::uint32_t> faces) const;
  void add_faces(std::span<const std::uint32_t> faces);
  // Some faces as a block of work has listed them.
  struct Listed {
    SolidFaces faces;
    Messages messages;
  };
  class Block;
  void join(std::vector<Listed>&& blocks);

  const Mesh& mesh_;
  const MeshSurface& surface_;
  MeshOptions options_;
  Messages* messages_;
  std::vector<std::uint32_t> order_;     // one vertex of each place, along a curve
  std::vector<std::uint32_t> rank_;      // place -> where it is there
  std::vector<std::uint32_t> point_of_;  // place -> point of the faces at hand
  SolidFaces f_;                         // these; names are places
  // Of the points of these, over the denominator of the mesh's; empty if they are not small.
  std::vector<std::array<std::int64_t, 3>> integers_;
  bool reverse_ = false;
};

/// All faces for try_make_solid, turned over (which is noted) if they enclose a negative volume. O(n log n).
SolidFaces solid_faces(const CheckedSurface& checked, const MeshOptions& options, Messages* messages);

}  // namespace nef

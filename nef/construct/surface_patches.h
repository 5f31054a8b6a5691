// SPDX-License-Identifier: Apache-2.0
//
// Which triangles of a surface can meet beyond the vertices and edges that they share, told face by face.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "nef/construct/mesh_surface.h"
#include "nef/geometry/box_tree.h"

namespace nef {

/// The planar pieces of a triangulated surface: whole planar faces, and single triangles of all others. Two patches
/// are told apart by the plane of one of them at the cost of one sign for each corner of the other, however many
/// triangles they have.
class SurfacePatches {
 public:
  /// The surface must outlive this object. O(n).
  explicit SurfacePatches(const MeshSurface& surface);

  /// Calls visit(t, u), t < u, in no particular order for pairs of triangles, among them all that have in common more
  /// than shared vertices and edges. O(n log n + k) for k pairs of patches with overlapping boxes; patches that can not
  /// be told apart add the pairs of their triangles with overlapping boxes.
  void for_each_candidate(const std::function<void(std::uint32_t, std::uint32_t)>& visit) const;

  /// True if the place is known to lie in the plane of the triangle: as a corner of the same planar face.
  [[nodiscard]] bool on_plane(std::uint32_t triangle, std::uint32_t place) const;

  /// True if the edge of the triangle between two of its corners is a cut through its planar face, not a side of it.
  [[nodiscard]] bool is_cut(std::uint32_t triangle, std::uint32_t u, std::uint32_t v) const;

 private:
  struct Patch {
    std::uint32_t first = 0, last = 0;  // triangles
    bool convex = true;
    [[nodiscard]] std::uint32_t size() const { return last - first; }
  };
  struct Corner {
    std::uint32_t face = 0;
    std::uint32_t position = 0;  // in the ring of the face
  };

  [[nodiscard]] std::span<const std::uint32_t> corners(const Patch& patch) const;
  [[nodiscard]] std::optional<std::uint32_t> position(const Patch& patch, std::uint32_t place) const;
  [[nodiscard]] std::optional<std::uint32_t> position_in_face(std::uint32_t face, std::uint32_t place) const;
  [[nodiscard]] bool apart(const Patch& p, const Patch& q) const;
  [[nodiscard]] Box box(std::span<const std::uint32_t> places) const;
  [[nodiscard]] std::vector<Box> triangle_boxes(const Patch& patch) const;
  void within(const Patch& patch, const std::function<void(std::uint32_t, std::uint32_t)>& visit) const;
  void between(const Patch& p, const Patch& q, const std::function<void(std::uint32_t, std::uint32_t)>& visit) const;

  const MeshSurface& surface_;
  std::vector<Patch> patches_;
  std::vector<std::uint32_t> corner_begin_;  // by place: corners of planar faces with more than three
  std::vector<Corner> corners_;
};

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
//
// Which triangles of a surface can meet beyond the vertices and edges that they share, told face by face.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/vertex_stars.h"

namespace nef {

/// The planar pieces of a triangulated surface: whole planar faces, and single triangles of all others. Two patches
/// are told apart by the plane of one of them at the cost of one sign for each corner of the other, however many
/// triangles they have. Where very many boxes overlap, as in a fan, coplanar neighbours are united to larger patches,
/// and the patches around a vertex of high degree are told apart by the directions in which they are seen from there.
class SurfacePatches {
 public:
  /// The surface must outlive this object. O(n).
  SurfacePatches(const MeshSurface& surface, const Monitor& monitor);

  /// Calls visit(t, u) in no particular order for pairs of triangles, among them all that have in common more than
  /// shared vertices and edges. O(n log n + k) for k pairs of patches with overlapping boxes, around a vertex of high
  /// degree of patches that are seen in the same direction from there, and of united patches if k is large; patches
  /// that can not be told apart add the pairs of their triangles with overlapping boxes.
  void for_each_candidate(const std::function<void(std::uint32_t, std::uint32_t)>& visit) const;

  /// Of the triangles.
  [[nodiscard]] const VertexStars& stars() const { return stars_; }

  /// True if the place is known to lie in the plane of the triangle: as a corner of the same planar face.
  [[nodiscard]] bool on_plane(std::uint32_t triangle, std::uint32_t place) const;

  /// True if the edge of the triangle between two of its corners is a cut through its planar face, not a side of it.
  [[nodiscard]] bool is_cut(std::uint32_t triangle, std::uint32_t u, std::uint32_t v) const;

 private:
  using Visit = std::function<void(std::uint32_t, std::uint32_t)>;
  friend class WideStars;

  struct Patch {
    std::uint32_t first = 0, last = 0;               // triangles, in the order of the layout
    std::uint32_t corner_begin = 0, corner_end = 0;  // none for single triangles
    bool proper = true;  // its triangles have nothing in common beyond shared vertices and edges
    [[nodiscard]] std::uint32_t size() const { return last - first; }
  };
  struct Corner {
    std::uint32_t patch = 0;
    std::uint32_t position = 0;  // among its corners
  };
  // One way to make patches of all triangles.
  struct Layout {
    std::vector<Patch> patches;
    std::vector<std::uint32_t> order;         // triangles, patch by patch; empty: as they are numbered
    std::vector<std::uint32_t> corners;       // of all patches of more than one triangle
    std::vector<std::uint32_t> next;          // of each, the position of the next on its cycle
    std::vector<std::uint32_t> corner_begin;  // by place, into `at`
    std::vector<Corner> at;
    [[nodiscard]] std::uint32_t triangle(std::uint32_t i) const { return order.empty() ? i : order[i]; }
  };

  // Trees over the triangles of patches, kept for those with many: a ring meets the boxes of all walls inside of it.
  class PatchTrees {
   public:
    PatchTrees(const SurfacePatches& patches, const Layout& layout) : patches_(patches), layout_(layout) {}
    [[nodiscard]] const Layout& layout() const { return layout_; }
    // Valid until the next call, if the patch has few triangles.
    const BoxTree& of(std::uint32_t patch);

   private:
    const SurfacePatches& patches_;
    const Layout& layout_;
    std::unordered_map<std::uint32_t, BoxTree> kept_;
    BoxTree last_;
  };

  [[nodiscard]] Layout planar_faces() const;
  [[nodiscard]] Layout united() const;
  void add_cycles(Layout& layout, std::span<const std::uint32_t> cycles, std::span<const std::uint32_t> ends) const;
  void index_corners(Layout& layout) const;

  [[nodiscard]] std::span<const std::uint32_t> corners(const Layout& layout, const Patch& patch) const;
  [[nodiscard]] std::optional<std::uint32_t> position(const Layout& layout, std::uint32_t patch,
                                                      std::uint32_t place) const;
  [[nodiscard]] bool apart(const Layout& layout, std::uint32_t p, std::uint32_t q) const;
  [[nodiscard]] Box box(std::span<const std::uint32_t> places) const;
  [[nodiscard]] std::vector<Box> triangle_boxes(const Layout& layout, const Patch& patch) const;
  [[nodiscard]] BoxTree tree(const Layout& layout) const;
  [[nodiscard]] std::vector<std::uint32_t> terrains(const Layout& layout, const BoxTree& tree) const;
  [[nodiscard]] std::vector<std::uint32_t> degrees(const Layout& layout) const;
  void within(const Layout& layout, const Patch& patch, const Visit& visit) const;
  void between(std::uint32_t p, std::uint32_t q, PatchTrees& trees, const Visit& visit) const;
  void visit_pair(std::uint32_t p, std::uint32_t q, PatchTrees& trees, const Visit& visit) const;

  const MeshSurface& surface_;
  Monitor monitor_;
  VertexStars stars_;
  std::vector<std::uint32_t> patch_of_face_;  // the last one of each face
  Layout faces_;
};

}  // namespace nef

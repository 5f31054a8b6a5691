// SPDX-License-Identifier: Apache-2.0
//
// What one view alone leaves of a small part of space, and which facets of other views do not matter there.
#pragma once

#include <optional>
#include <vector>

#include "apps/visual_hull/viewing_edges/edge_scene.h"
#include "apps/visual_hull/viewing_edges/part_vertices.h"

namespace nef::visual_hull {

/// What halving asks of an edge, close together.
struct PartFacet {
  std::array<double, 2> low{}, high{};  ///< of the edge in its image
  Double3 normal{};                     ///< of its plane
  double offset = 0;
  double error = 0;  ///< of the height of a point in the scene's box over the plane, with room for roundings

  [[nodiscard]] double height(const Double3& point) const {
    return offset + normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2];
  }
};

/// Of all edges.
std::vector<PartFacet> facets_of(const EdgeScene& scene);

/// A half-space that is all of a part that a view shows as object: it has one edge there, which runs right across.
class PartCut {
 public:
  /// Nothing unless `facet`, of `edge`, is surely such an edge: `window` holds the image of the part, and no other edge
  /// of the view comes near both.
  static std::optional<PartCut> make(std::uint32_t view, const PartFacet& facet, const ViewingEdge& edge,
                                     const PartBox& box, const EdgeView::Window& window);

  [[nodiscard]] std::uint32_t view() const { return view_; }

  /// How much of the part is left along the plane's normal: 0 nothing, 2 all.
  [[nodiscard]] double share() const { return share_; }

  /// True if the plane of a facet, which passes the part, surely does not meet what is left.
  [[nodiscard]] bool misses(const PartFacet& facet) const;

  /// A point of what is left.
  [[nodiscard]] const Double3& point() const { return point_; }

 private:
  [[nodiscard]] bool positive(double height, const Double3& slope, double error) const;

  std::uint32_t view_ = 0;
  PartBox box_;
  double height_ = 0;  // of the middle over the plane
  Double3 slope_{};    // by how much that grows from the middle to the sides
  double error_ = 0;
  double share_ = 2;
  Double3 point_{};
};

}  // namespace nef::visual_hull

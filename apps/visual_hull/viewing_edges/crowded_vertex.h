// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "apps/visual_hull/viewing_edges/edge_view.h"
#include "nef/base/monitor.h"
#include "nef/sphere_map/overlay.h"

namespace nef::visual_hull {

/// A point of the hull that lies on the planes of more than three edges, or of three in special position: perhaps a
/// vertex.
struct CrowdedVertex {
  Rational3 point;
  std::vector<std::uint32_t> edges;  ///< all edges that show it, view by view, ascending
};

/// What the hull looks like around crowded vertices: one after the other, by overlays of sphere maps.
class CrowdedPyramids {
 public:
  /// `planes` is where plane(e) puts the plane of edge e, positive towards the region.
  CrowdedPyramids(std::span<const ViewingEdge> edges, const nef::PlaneTable& planes, const nef::Monitor& monitor,
                  std::function<nef::PlaneId(std::uint32_t)> plane);

  /// The sphere map, simplified; valid until the next call. O(n^2) for n edges.
  nef::SphereMapView at(const CrowdedVertex& vertex);

 private:
  void add_view(std::span<const std::uint32_t> edges, nef::SphereMapBuffer& result);
  void add_sector(std::uint32_t in, std::uint32_t out, nef::SphereMapBuffer& result);
  void combine(nef::SphereMapBuffer& result, const nef::SphereMapBuffer& other, const nef::LabelFunction& function);

  std::span<const ViewingEdge> edges_;
  const nef::PlaneTable& planes_;
  nef::Monitor monitor_;
  std::function<nef::PlaneId(std::uint32_t)> plane_;
  nef::SphereOverlay overlay_;
  nef::LabelFunction both_;
  nef::LabelFunction either_;
  nef::SphereMapBuffer all_;
  nef::SphereMapBuffer scratch_;
};

}  // namespace nef::visual_hull

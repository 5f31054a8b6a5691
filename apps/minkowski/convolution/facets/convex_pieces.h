// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef::minkowski {

/// Cuts facets into convex polygons between their own vertices.
class ConvexPieces {
 public:
  /// The complex must outlive the object; its points must be finite.
  ConvexPieces(const Complex& complex, const Monitor& monitor)
      : c_(complex), monitor_(monitor), points_(complex.points), triangulator_(points_, monitor) {}

  /// Polygons of vertices of the complex, counterclockwise about the facet's (unflipped) plane. Triangles of a
  /// triangulation are merged as long as what comes of it is convex [Hertel, Mehlhorn 1983], but not across edges:
  /// at most four times as many as there must be. O(n) for a convex facet.
  std::vector<std::vector<std::uint32_t>> cut(FacetId facet);

 private:
  using Ring = std::vector<std::uint32_t>;
  [[nodiscard]] bool turns_left(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
  [[nodiscard]] bool is_convex(const Ring& ring) const;
  void find_slits(const std::vector<Ring>& rings);
  [[nodiscard]] bool is_slit(std::uint32_t u, std::uint32_t v) const;
  [[nodiscard]] bool merge(Ring& ring, const Ring& other) const;

  const Complex& c_;
  Monitor monitor_;
  MeshPoints points_;
  Triangulator triangulator_;
  std::unordered_set<std::uint64_t> sides_;  // of the facet at hand, from vertex to vertex
  std::size_t axis_ = 0;
  int sign_ = 1;
};

}  // namespace nef::minkowski

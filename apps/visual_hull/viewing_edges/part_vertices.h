// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/visual_hull/viewing_edges/edge_scene.h"
#include "apps/visual_hull/viewing_edges/hull_complex.h"
#include "apps/visual_hull/viewing_edges/plane_triple.h"
#include "nef/base/monitor.h"

namespace nef::visual_hull {

/// A box of space: its middle and half of its sides.
struct PartBox {
  Double3 middle{};
  Double3 half{};
};

/// The edges that a view shows in a part: a range of a list.
struct Shown {
  std::uint32_t view = 0;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// Finds the vertices of the hull in small parts of space, one part after the other. For one thread.
class PartVertices {
 public:
  PartVertices(const EdgeScene& scene, const nef::Monitor& monitor) : s_(scene), monitor_(monitor) {}

  /// Adds the vertices in a part to `found`; those within kOverlap of its border may be missing. `views` are those that
  /// show edges in the part, each with all of them and perhaps some more; all other views show nothing but object.
  /// False if a view may not see all of the part, or more exact points were asked for than the way is worth. O(n^3) for
  /// n edges, with a small constant.
  [[nodiscard]] bool find(const PartBox& box, std::span<const Shown> views, std::span<const std::uint32_t> edges);

  /// In any order, perhaps repeated by other parts.
  HullVertices found;

 private:
  struct Facet {
    std::uint32_t edge = 0;
    std::uint32_t view = 0;
    CubePlane plane;
  };

  void collect(std::span<const Shown> views, std::span<const std::uint32_t> edges);
  void pair_up();
  [[nodiscard]] bool neighbours(std::uint32_t e, std::uint32_t f) const;
  [[nodiscard]] bool consider(std::span<const Shown> views, std::size_t a, std::size_t b, std::size_t c);
  [[nodiscard]] const Double3& cross_of(std::size_t a, std::size_t b) const { return crosses_[a * facets_.size() + b]; }
  [[nodiscard]] Answer on_hull(std::span<const Shown> views, const SpotName& name, const Spot& spot,
                               const ExactPoint* exact) const;
  [[nodiscard]] bool consider_exactly(std::span<const Shown> views, const SpotName& name);
  [[nodiscard]] bool add_crowded(std::span<const Shown> views, const ExactPoint& exact, const Spot& spot);
  [[nodiscard]] bool in_crowd(const SpotName& name) const;

  const EdgeScene& s_;
  nef::Monitor monitor_;
  PartBox box_;
  std::vector<Facet> facets_;
  std::vector<Double3> crosses_;  // of the normals of each two facets, row by row
  std::size_t words_ = 0;
  std::vector<std::uint64_t> meet_;  // row by row: bits of the later facets whose line with each may pass the cube
  std::size_t first_crowded_ = 0;    // of the part
};

}  // namespace nef::visual_hull

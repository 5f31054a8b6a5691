// SPDX-License-Identifier: Apache-2.0
//
// Two sets that are asked whether they meet, and what of both is the same for all translations.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "nef/complex/complex.h"
#include "nef/complex/item_ref.h"
#include "nef/distance/crossing_filter.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/polyhedron.h"

namespace nef {

/// An edge and the vertices at its ends.
struct EdgeEnds {
  HalfedgeId halfedge{0};
  VertexId from{0}, to{0};
};

/// The box moved, rounded outward: doubles of boxes and of the translation are within 2^-52 relative, and each bound
/// rounds once more.
Box shifted(const Box& box, const std::array<double, 3>& by);

/// The sum of two points.
inline Approximation3 moved_by(const Approximation3& point, const Approximation3& by) {
  return {point[0] + by[0], point[1] + by[1], point[2] + by[2]};
}

/// One of the two sets, its edges and facets in trees of boxes.
struct MeetingSide {
  /// The set must be bounded. Keeps a copy of it. O(n log n).
  explicit MeetingSide(const Polyhedron& of);

  /// The tree over the edges of a facet with many corners; null for other facets.
  [[nodiscard]] const BoxTree* tree_of(FacetId facet) const {
    const auto found = trees.find(facet.index());
    return found == trees.end() ? nullptr : &found->second;
  }

  /// A vertex on the part of the boundary, connected by edges, that an item is on; kNone for facets.
  [[nodiscard]] std::uint32_t part_of(const ItemRef& place) const {
    if (place.kind == ItemRef::Kind::kVertex) return part[place.vertex().index()];
    return place.kind == ItemRef::Kind::kEdge ? part[c.source(place.halfedge()).index()] : kNone;
  }

  Polyhedron set;
  const Complex& c;
  std::vector<Rational3> points;
  std::vector<EdgeEnds> edges, bare;     ///< bare edges bound no facet
  std::optional<CrossingFilter> filter;  ///< once the points are known
  BoxTree edge_tree, facet_tree;
  BoxTree::Rough rough_edges, rough_facets;
  std::unordered_map<std::size_t, BoxTree> trees;  ///< of facets with many corners
  Box bounds;
  std::vector<std::uint32_t> part;   ///< per vertex, one of those that edges connect it with
  std::vector<std::uint32_t> parts;  ///< these
};

/// Both sets.
struct MeetingSets {
  /// Keeps copies of both. O(n log n) for bounded sets, which are what has sides.
  MeetingSets(const Polyhedron& of_a, const Polyhedron& of_b);

  std::array<Polyhedron, 2> sets;
  std::vector<std::unique_ptr<const MeetingSide>> sides;  ///< none if a set is empty or unbounded
  PlaneTable planes;                                      ///< through the origin
  std::vector<std::vector<PlaneId>> normals;              ///< of each side's planes
};

/// Calls visit(edge, facet) for pairs of an edge of one side, moved, and a facet of the other one whose boxes meet, or
/// all but do, until it returns false.
template <typename Visit>
void for_each_near_pair(const MeetingSide& own, const std::array<double, 3>& by, const MeetingSide& other,
                        Visit&& visit) {
  own.edge_tree.for_each_pair_with(own.rough_edges, other.facet_tree, other.rough_facets,
                                   RoughBox::Moved(own.bounds, by), visit);
}

}  // namespace nef

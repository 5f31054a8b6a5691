// SPDX-License-Identifier: Apache-2.0
//
// The structure behind point location and ray shooting: a hierarchy of boxes over facets, edges
// without facets, and vertices that bound no facet. Every answer is exact.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/complex/item_ref.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/location/compare.h"

namespace nef {

/// A vertex, edge (as a halfedge) or facet of a complex that is met by a ray.
struct ComplexHit : ItemRef {
  explicit ComplexHit(ItemRef item) : ItemRef(item) {}
  /// A facet that a ray meets from that side.
  explicit ComplexHit(HalffacetId from) : ItemRef(facet_of(from)), halffacet(from) {}

  /// Facet: the side that the ray comes from.
  HalffacetId halffacet;
  /// Vertex or edge: the sface (at that vertex or at the source of that halfedge) through which the ray
  /// comes. None if the ray comes along a facet or an edge, and for facets.
  SFaceId sface;
};

/// An open ray: from a point (excluded) in an exact direction (not zero).
struct QueryRay {
  PointRef origin;
  const Direction& direction;  ///< must outlive the ray
};

/// Built from a complex with edges, facets and cycles; volumes and shells are needed only by
/// volume_at and volume_before. Keeps no reference: each query is given the complex (the same one,
/// or a copy of it). Queries may run in several threads at once.
class QueryStructure {
 public:
  using Accept = std::function<bool(const ComplexHit&)>;

  /// O(n log n).
  explicit QueryStructure(const Complex& complex);

  /// The same for queries whose points or rays lie in the boxes of `places`: nothing else is found. What lies apart
  /// from all of them costs a question.
  QueryStructure(const Complex& complex, const BoxTree& places);

  /// The vertex, edge or facet that contains the point; none if it lies in a volume. O(log n) expected.
  [[nodiscard]] ItemRef item_at(const Complex& complex, const PointRef& point, const Monitor& monitor) const;

  /// The first vertex, edge or facet that the ray meets and `accept` (if given) takes. A facet
  /// in whose plane the ray runs and an edge on whose line it runs are not met themselves, but
  /// their boundaries are. `at`, if given, becomes the point that is met (finite rays only).
  [[nodiscard]] std::optional<ComplexHit> first_hit(const Complex& complex, const QueryRay& ray, const Accept& accept,
                                                    Rational3* at, const Monitor& monitor) const;

  /// The first vertex, edge or facet strictly left (smaller x, same y and z) of a vertex, which
  /// may be infimaximal.
  [[nodiscard]] std::optional<ComplexHit> first_hit_minus_x(const Complex& complex, VertexId vertex,
                                                            const Monitor& monitor) const;

  /// The sface of that first item which bounds the region between it and the vertex;
  /// none if there is no such item. The vertex must have nothing of its own in direction -x.
  [[nodiscard]] SFaceId first_sface_minus_x(const Complex& complex, VertexId vertex, const Monitor& monitor) const;

  /// The volume that holds a point which item_at does not find on anything.
  [[nodiscard]] VolumeId volume_at(const Complex& complex, const PointRef& point, const Monitor& monitor) const;

  [[nodiscard]] std::size_t bytes() const;

 private:
  friend class RayShooter;

  struct LargeFacet;  // its tree, built at the first query that needs it

  // What an item of the tree is: 4 * index + kind.
  enum Primitive : std::uint32_t { kFacetItem = 0, kEdgeItem = 1, kVertexItem = 2 };

  void collect(const Complex& complex, const BoxTree* places);
  void push_item(std::uint32_t index, Primitive kind, const Box& box, std::vector<Box>& boxes);
  [[nodiscard]] const BoxTree* edge_tree(const Complex& complex, FacetId facet) const;
  [[nodiscard]] std::optional<VertexId> free_vertex_at(const Complex& complex, const PointRef& point,
                                                       const Monitor& monitor) const;

  // Holds the boxes mirrored at the origin, so that its order of traversal (small coordinates
  // first) goes outward from the origin of a ray towards -x, the direction that location uses.
  BoxTree tree_;
  std::vector<std::uint32_t> items_;
  std::vector<FacetId> large_facets_;    // sorted
  std::shared_ptr<LargeFacet[]> large_;  // parallel
};

/// The volume in which the ray runs just before the hit. The hit must have come through one (its
/// `sface` is known, or it is a facet).
VolumeId volume_before(const Complex& complex, const ComplexHit& hit);

}  // namespace nef

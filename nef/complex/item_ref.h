// SPDX-License-Identifier: Apache-2.0
//
// A name for any item of a complex.
#pragma once

#include <compare>
#include <cstdint>

#include "nef/base/error.h"
#include "nef/complex/ids.h"

namespace nef {

/// A vertex, edge, facet or volume of a complex, or none: its kind and its number among these. An edge is named by
/// either of its halfedges; a function that gives one says which.
struct ItemRef {
  enum class Kind : std::uint8_t { kNone, kVertex, kEdge, kFacet, kVolume };
  Kind kind = Kind::kNone;
  std::uint32_t index = 0;  ///< of the vertex, halfedge, facet or volume

  constexpr ItemRef() = default;
  constexpr explicit ItemRef(VertexId vertex) : kind(Kind::kVertex), index(vertex.index()) {}
  constexpr explicit ItemRef(HalfedgeId edge) : kind(Kind::kEdge), index(edge.index()) {}
  constexpr explicit ItemRef(FacetId facet) : kind(Kind::kFacet), index(facet.index()) {}
  constexpr explicit ItemRef(VolumeId volume) : kind(Kind::kVolume), index(volume.index()) {}

  /// False if it is no item.
  [[nodiscard]] constexpr bool valid() const { return kind != Kind::kNone; }

  /// The typed number; the item must be of that kind.
  [[nodiscard]] VertexId vertex() const { return number<VertexId>(Kind::kVertex); }
  [[nodiscard]] HalfedgeId halfedge() const { return number<HalfedgeId>(Kind::kEdge); }
  [[nodiscard]] FacetId facet() const { return number<FacetId>(Kind::kFacet); }
  [[nodiscard]] VolumeId volume() const { return number<VolumeId>(Kind::kVolume); }

  auto operator<=>(const ItemRef&) const = default;

 private:
  template <typename Id>
  [[nodiscard]] Id number(Kind expected) const {
    NEF_ASSERT(kind == expected);
    return Id{index};
  }
};

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
//
// Facets of a convolution as sums of features, as one thread finds them.
#pragma once

#include <cstdint>
#include <vector>

#include "nef/geometry/ids.h"
#include "nef/geometry/vectors.h"
#include "nef/mesh/edge_order.h"

namespace nef::minkowski {

/// Convex polygons whose corners and planes have no numbers yet. A corner is known by the vertices of A and B that it
/// is the sum of, and a plane by its normal and a corner. Lists are put together by `numbered_facets`.
class FacetList {
 public:
  /// What is square to a facet: the normal of a facet of A or B, or the product of the lines of an edge of A and one of
  /// B, or of these in the other order.
  struct Normal {
    enum class Kind : std::uint8_t { kFacetOfA, kFacetOfB, kLines, kLinesTurned };
    Kind kind = Kind::kFacetOfA;
    PlaneId plane;               ///< of the facet
    std::uint32_t a = 0, b = 0;  ///< numbers of the lines
  };

  /// `mixed`: marks are kept.
  explicit FacetList(bool mixed = false) : is_mixed_(mixed) {}

  /// What a corner is known by that is the sum of a vertex of A and one of B.
  static std::uint64_t sum_of(std::uint32_t a, std::uint32_t b) { return pair_key(a, b); }
  /// The same for any other point.
  std::uint64_t add_point(const Rational3& point) {
    points_.push_back(point);
    return pair_key(kNoVertex, static_cast<std::uint32_t>(points_.size() - 1));
  }

  /// A corner of the facet that is being made, and the side that begins there.
  void add_corner(std::uint64_t corner, int mark, int side) {
    corners_.push_back(corner);
    if (!is_mixed_) return;
    corner_marks_.push_back(static_cast<std::uint8_t>(mark));
    side_marks_.push_back(static_cast<std::uint8_t>(side));
  }

  /// Ends the facet.
  void end_facet(const Normal& normal, int inside) {
    normals_.push_back(normal);
    ends_.push_back(static_cast<std::uint32_t>(corners_.size()));
    if (is_mixed_) inside_marks_.push_back(static_cast<std::uint8_t>(inside));
  }

 private:
  friend class FacetNumbering;
  static constexpr std::uint32_t kNoVertex = 0xffffffffU;

  bool is_mixed_;
  std::vector<std::uint64_t> corners_;
  std::vector<Rational3> points_;  // corners that are no sums of vertices
  std::vector<std::uint32_t> ends_;
  std::vector<Normal> normals_;
  std::vector<std::uint8_t> inside_marks_, corner_marks_, side_marks_;
};

}  // namespace nef::minkowski

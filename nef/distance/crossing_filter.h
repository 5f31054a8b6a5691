// SPDX-License-Identifier: Apache-2.0
//
// Whether edges cross facets, as far as doubles tell.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "nef/complex/complex.h"
#include "nef/geometry/vectors.h"
#include "nef/number/approximation.h"
#include "nef/number/number.h"

namespace nef {

/// What doubles tell of an edge and a facet.
enum class EdgeCrossing : std::uint8_t {
  kApart,    ///< they have no point in common, not even on their borders
  kCrosses,  ///< one point in common, in the inside of both, and the edge is not in the facet's plane
  kUnsure
};

/// The facets of a complex in doubles, all of whose points must be finite.
class CrossingFilter {
 public:
  /// `points`: of all vertices. O(n).
  CrossingFilter(const Complex& complex, std::span<const Rational3> points);

  /// The edge is given by its ends. O(corners of the facet), or those in a row of it if there are many.
  [[nodiscard]] EdgeCrossing ask(FacetId facet, const Approximation3& from, const Approximation3& to) const;

  /// A vertex of the complex.
  [[nodiscard]] const Approximation3& point(VertexId v) const { return points_[v.index()]; }

 private:
  [[nodiscard]] Approximation value(const Approximation3& normal, const Approximation& offset,
                                    const Approximation3& at) const;

  [[nodiscard]] std::optional<bool> holds(FacetId facet, const Approximation3& at, std::size_t u, std::size_t v) const;

  struct Plane {
    Approximation3 normal;
    Approximation offset;
    std::size_t axis = 0;          // along which the normal is largest
    std::uint32_t rows = kNoRows;  // of a facet with many corners: the first of two, by its other two axes
  };
  static constexpr std::uint32_t kNoRows = 0xffffffff;

  // The sides of a facet by rows across an axis, where they are or nearly are.
  struct Rows {
    double low = 0, height = 0;        // of the first row, of each
    std::vector<std::uint32_t> begin;  // per row
    std::vector<std::uint32_t> sides;
  };
  // True if there are not too many sides in too many rows.
  [[nodiscard]] bool make_rows(std::span<const std::array<std::uint32_t, 2>> sides, std::size_t axis, Rows& rows) const;

  std::vector<Approximation3> points_;
  std::vector<Plane> planes_;         // per facet
  std::vector<std::uint32_t> begin_;  // of each facet's sides
  std::vector<std::array<std::uint32_t, 2>>
      sides_;  // vertices; none of facets with vertices inside, which are not asked
  std::vector<Rows> rows_;
};

}  // namespace nef

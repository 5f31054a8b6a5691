// SPDX-License-Identifier: Apache-2.0
//
// Which cell counts where faces of several lie in one plane: the caps of a thousand prisms, say.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/cells/exact_cells.h"
#include "apps/minkowski/convex/convex_cell.h"

namespace nef::minkowski {

// A cell D covers another cell C at a point x of C if D's local pyramid there holds C's: then C adds nothing at x. That
// is so if x is inside of each face of D but for some that are flush: each in the plane of a face of C, on the same
// side. For the planes of D at x are then among those of C at x. If they are all of them, the pyramids are equal, and
// one of the two cells has to stay.

/// What the covering cell is next to a point, against the covered one.
enum class Pyramid : std::uint8_t { kLarger, kEqual };

/// Whether cell d may cover cell c where its pyramid is larger, or equal, apart from boundaries: closed cells cover
/// all, open ones cover open ones. Of equal ones closed comes before open, then the first by number, so that there are
/// no cycles.
inline bool may_cover(std::span<const ConvexCell> cells, std::uint32_t d, std::uint32_t c, Pyramid pyramid) {
  using Boundary = ConvexCell::Boundary;
  const Boundary over = cells[d].boundary;
  const Boundary under = cells[c].boundary;
  if (over == Boundary::kMixed || (over == Boundary::kOpen && under != Boundary::kOpen)) return false;
  return over != under || pyramid == Pyramid::kLarger || d < c;
}

/// The planes of the faces of each cell, as far as they are known when it is made.
class PlanesOfCells {
 public:
  PlanesOfCells() = default;
  PlanesOfCells(const RoundedCells& rounded, const ExactCells& exact) {
    for (std::uint32_t cell = 0; cell < rounded.size(); ++cell) {
      const auto first = static_cast<std::ptrdiff_t>(planes_.size());
      for (std::uint32_t f = rounded.first_face(cell); f < rounded.end_face(cell); ++f) {
        if (exact.known_plane(f).valid()) planes_.push_back(exact.known_plane(f));
      }
      std::sort(planes_.begin() + first, planes_.end());
      begin_.push_back(static_cast<std::uint32_t>(planes_.size()));
    }
  }

  /// True if a cell is known to have a face in an oriented plane; false if `plane` is not valid. O(log faces).
  [[nodiscard]] bool has(std::uint32_t cell, PlaneId plane) const {
    return plane.valid() &&
           std::binary_search(planes_.begin() + begin_[cell], planes_.begin() + begin_[cell + 1], plane);
  }

 private:
  std::vector<PlaneId> planes_;
  std::vector<std::uint32_t> begin_{0};
};

/// Which faces of other cells are flush with a cell: in the plane of a face of it, on the same side. All arguments of
/// the constructor must outlive the object.
class FlushFaces {
 public:
  FlushFaces(std::span<const ConvexCell> cells, const RoundedCells& rounded, const ExactCells& exact,
             const PlanesOfCells& planes)
      : cells_(cells), rounded_(rounded), exact_(exact), planes_(planes) {}

  /// True if the cell of face h, as if it had no such face, covers what it then holds of face f of another cell.
  /// O(log faces).
  [[nodiscard]] bool may_miss(std::uint32_t h, std::uint32_t f) const {
    const PlaneId plane = exact_.known_plane(h);
    const std::uint32_t cell = rounded_.cell_of_face(f);
    if (!planes_.has(cell, plane)) return false;
    const Pyramid pyramid = plane == exact_.known_plane(f) ? Pyramid::kEqual : Pyramid::kLarger;
    return may_cover(cells_, rounded_.cell_of_face(h), cell, pyramid);
  }

 private:
  std::span<const ConvexCell> cells_;
  const RoundedCells& rounded_;
  const ExactCells& exact_;
  const PlanesOfCells& planes_;
};

}  // namespace nef::minkowski

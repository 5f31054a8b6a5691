// SPDX-License-Identifier: Apache-2.0
//
// What other cells leave of a face: a filter that says where on a face the boundary of a union may be.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/cells/rounded_cells.h"

namespace nef::minkowski {

/// Subtracts the insides of cells from a face, in doubles and on the safe side.
class FaceRemains {
 public:
  /// The cells must outlive the object.
  explicit FaceRemains(const RoundedCells& cells);

  /// The box around what may be left of the convex polygon `ring` (rounded corners of a face) without
  /// the insides of the `neighbours`; an empty box (low > high) if surely nothing is left. Cells that
  /// took something away move to the front of the list: they are likely to do so for the next face.
  Box box_of_rest(std::span<const Vector> ring, std::vector<std::uint32_t>& neighbours);

  /// From now on the cell of `face` counts as if it had no such face: it takes away what is inside of its other faces.
  /// For polygons in the plane of that face, whose insides it then hides as well.
  void ignore(std::uint32_t face);
  /// Undoes that.
  void heed(std::uint32_t face);

 private:
  static constexpr std::size_t kCorners = 24;
  struct Polygon {
    std::array<Vector, kCorners> v;
    std::size_t size = 0;
    [[nodiscard]] Vector centre() const;
  };
  std::uint32_t cell_around(const Vector& x, std::vector<std::uint32_t>& neighbours) const;
  bool subtract(const Polygon& polygon, std::uint32_t cell);

  const RoundedCells& cells_;
  std::vector<double> surely_inside_;  // per face: a value below it is surely inside
  std::vector<double> inside_;         // the same, but for faces that are ignored
  std::vector<Polygon> todo_, outside_;
  std::vector<double> values_;
};

}  // namespace nef::minkowski

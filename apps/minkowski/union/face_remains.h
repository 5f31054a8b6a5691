// SPDX-License-Identifier: Apache-2.0
//
// What other cells leave of a face: a filter that says where on a face the boundary of a union may be.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/minkowski/cells/rounded_cells.h"
#include "apps/minkowski/union/coplanar.h"
#include "nef/geometry/search/box_tree.h"

namespace nef::minkowski {

/// Subtracts the insides of cells from a face, in doubles and on the safe side. A cell whose face is flush takes away
/// what is inside of its other faces.
class FaceRemains {
 public:
  /// All must outlive the object. `boxes` is a tree over the cells' boxes.
  FaceRemains(const RoundedCells& cells, const FlushFaces& flush, const BoxTree& boxes);

  /// The box around what may be left of a face, whose rounded corners are `ring`, without the insides of other cells;
  /// an empty box (low > high) if surely nothing is left. Which cells took something away from the faces before has to
  /// do with how small the box is, but not with whether it is empty.
  Box box_of_rest(std::uint32_t face, std::span<const Double3> ring);

 private:
  static constexpr std::size_t kCorners = 24;
  static constexpr std::size_t kCuts = 0x10000;  // of the pieces of a face
  // Copies are made of the corners that there are, which mostly are a few of the room.
  struct Polygon {
    std::array<Double3, kCorners> v;
    std::size_t size = 0;
    Polygon() = default;
    Polygon(const Polygon& other) : size(other.size) { std::copy_n(other.v.begin(), size, v.begin()); }
    Polygon& operator=(const Polygon& other) {
      size = other.size;
      std::copy_n(other.v.begin(), size, v.begin());
      return *this;
    }
    ~Polygon() = default;
    [[nodiscard]] Double3 centre() const;
    // False if there is no room.
    [[nodiscard]] bool push(const Double3& corner) {
      if (size == kCorners) return false;
      v[size++] = corner;
      return true;
    }
  };
  // Whether a cell whose box holds a point has it inside.
  [[nodiscard]] bool has_inside(std::uint32_t cell, const Double3& x);
  std::uint32_t cell_around(const Double3& x);
  bool cut(const Polygon& polygon, Polygon& inside, Polygon& beyond) const;
  bool subtract(const Polygon& polygon, std::uint32_t cell);

  const RoundedCells& cells_;
  const FlushFaces& flush_;
  const BoxTree& boxes_;
  std::vector<double> inside_;             // per face: a value below it is surely inside
  std::vector<std::uint32_t> beyond_;      // per cell: the face beyond which the point was that was asked for last
  std::vector<std::uint32_t> helpful_;     // cells that took something away, the last one first
  std::vector<std::uint32_t> neighbours_;  // of the cell whose box is neighbours_of_
  std::uint32_t neighbours_of_ = kNone;
  std::uint32_t face_ = 0;  // the one at hand
  std::size_t cuts_ = 0;    // of its pieces
  std::vector<Polygon> todo_, outside_;
  std::vector<double> values_;
};

}  // namespace nef::minkowski

// SPDX-License-Identifier: Apache-2.0
//
// Soups of closed surfaces, and how often faces wind around points, in fractions.
#pragma once

#include <optional>
#include <vector>

#include "fuzz/choices.h"
#include "nef/mesh/mesh.h"

namespace nef::fuzz {

/// Which parts a soup has.
enum class SoupParts {
  kAny,    ///< boxes, tetrahedra, slits, pyramids over polygons that cross themselves, parts again and turned over
  kSolid,  ///< boxes and tetrahedra with a volume, turned outward
};

/// A soup of some parts, on a grid, or sheared, or rounded from turned ones to multiples of a small power of two. Boxes
/// that are no boxes after rounding have triangles for faces.
Mesh random_soup(Choices& choices, SoupParts parts);

/// How often the faces of a closed mesh wind around points: the faces and any apex span tetrahedra, and a point is
/// wound around by the sum of the signs of those that hold it. Shares no code with the suite but vectors of fractions.
class FaceWindings {
 public:
  /// Faces are planar.
  explicit FaceWindings(const Mesh& mesh);

  /// The volume that the faces enclose, with signs.
  [[nodiscard]] const Rational& volume() const { return volume_; }
  /// Nothing if the point or the apex lies in the plane of a triangle of the sum. O(faces).
  [[nodiscard]] std::optional<int> around(const Rational3& point) const;
  /// A point between some vertices, off the grid.
  [[nodiscard]] Rational3 sample(Choices& choices) const;

 private:
  const Mesh& mesh_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;  // fans of the faces, without flat ones
  Rational volume_;
};

}  // namespace nef::fuzz

// SPDX-License-Identifier: Apache-2.0
//
// Directions of the features of a set: normals of facets and lines of edges, in doubles at hand and in integers where
// these do not tell.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/minkowski/convolution/facets/near_vector.h"
#include "nef/base/fast_path.h"
#include "nef/complex/complex.h"
#include "nef/number/integer_rows.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::minkowski {

/// The normal of a plane. The table must outlive it.
class PlaneNormal {
 public:
  PlaneNormal() = default;
  PlaneNormal(const PlaneTable& planes, PlaneId plane)
      : planes_(&planes), plane_(plane), near_(near_vector(Direction::normal(planes, plane))) {}

  [[nodiscard]] const NearVector& near() const { return near_; }
  /// Up to a positive factor.
  [[nodiscard]] Integer3 integers() const;
  [[nodiscard]] Direction direction() const { return Direction::normal(*planes_, plane_); }

 private:
  friend class EdgeLines;
  const PlaneTable* planes_ = nullptr;
  PlaneId plane_;
  NearVector near_;
};

/// True if two normals are positive multiples of each other.
bool same_direction(const PlaneNormal& u, const PlaneNormal& v, const Monitor& monitor);

/// The directions of the edges of a complex, one for both halfedges of each: along the one of lower number. May be
/// shared between threads.
class EdgeLines {
 public:
  EdgeLines() = default;
  /// O(n), on the threads of `monitor`.
  EdgeLines(const Complex& complex, const Monitor& monitor);

  /// The number of a halfedge's edge; edges are numbered in the order of their lower halfedges.
  [[nodiscard]] std::uint32_t edge_of(HalfedgeId halfedge) const { return edge_of_[halfedge]; }

  [[nodiscard]] const NearVector& near(std::uint32_t edge) const { return near_[edge]; }
  /// Up to a positive factor.
  [[nodiscard]] Integer3 integers(std::uint32_t edge) const;
  [[nodiscard]] Direction direction(std::uint32_t edge) const;

  /// The sign of the product of an edge's direction and a normal.
  [[nodiscard]] int sign_of_dot(std::uint32_t edge, const PlaneNormal& normal, const Monitor& monitor) const {
    const int sure = kFastPaths ? sure_sign_of_dot(near_[edge], normal.near()) : 0;
    return sure != 0 ? sure : exact_sign_of_dot(edge, normal, monitor);
  }

 private:
  [[nodiscard]] int exact_sign_of_dot(std::uint32_t edge, const PlaneNormal& normal, const Monitor& monitor) const;

  IndexedVector<HalfedgeId, std::uint32_t> edge_of_;
  std::vector<NearVector> near_;
  IntegerRows integers_{3};
};

}  // namespace nef::minkowski

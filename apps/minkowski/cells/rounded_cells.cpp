// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/cells/rounded_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nef::minkowski {

// For vertices within 2u*size (nearest doubles are within u relative), two edges a, b of a face of
// extent L have components within e = 8u*size of the truth, so a component of a x b is within
// 2 (2 L e + e^2) + 6u L^2; a third vector of extent M, within e likewise, gives a form within
// 3 (M (4.1 L e + 6u L^2) + 2 L^2 e) + 12u * 6 L^2 M. M is at most 2 size. Any e > L/8 is refused. For moderate sizes
// L is above 2^-250 then: nothing overflows, and what vanishes is far below the last term.
RoundedFace rounded_plane(const Double3& o, const Double3& p, const Double3& q, double size) {
  Double3 a{};
  Double3 b{};
  double extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = p[i] - o[i];
    b[i] = q[i] - p[i];
    extent = std::max({extent, std::fabs(a[i]), std::fabs(b[i])});
  }
  const double e = 8 * kUnit * size;
  const double reach = 2 * size;
  RoundedFace face;
  face.origin = o;
  face.normal = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  face.slack = e * 8 > extent || !has_moderate_size(size)
                   ? std::numeric_limits<double>::infinity()
                   : 1.1 * (3 * (reach * (4.5 * extent * e + 6 * kUnit * extent * extent) + 2 * extent * extent * e) +
                            72 * kUnit * extent * extent * reach) +
                         1e-290;
  // The true normal is longer than this one by less than a part in ten where the slack is finite and of use.
  face.weight = std::fabs(face.normal[0]) + std::fabs(face.normal[1]) + std::fabs(face.normal[2]) +
                3 * (4.5 * extent * e + 6 * kUnit * extent * extent);
  return face;
}

RoundedCells::RoundedCells(std::span<const ConvexCell> cells) {
  for (const ConvexCell& cell : cells) {
    Box& box = boxes_.emplace_back();
    for (const Rational3& p : cell.mesh.vertices) {
      const Double3 x = nearest_doubles(p);
      for (const double value : x) extent_ = std::max(extent_, std::fabs(value));
      vertices_.push_back(x);
      box.add_rounded(x);
    }
    first_vertex_.push_back(static_cast<std::uint32_t>(vertices_.size()));
  }
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const Mesh& mesh = cells[i].mesh;
    const std::span<const Double3> v = vertices(i);
    for (std::size_t f = 0; cells[i].dimension == 3 && f < mesh.face_count(); ++f) {
      // Far corners: the error is relative to the extent of the triangle.
      const auto face = mesh.face(f);
      faces_.push_back(rounded_plane(v[face[0]], v[face[face.size() / 3]], v[face[2 * face.size() / 3]], extent_));
      cell_of_face_.push_back(i);
    }
    first_face_.push_back(static_cast<std::uint32_t>(faces_.size()));
  }
}

bool RoundedCells::surely_inside(std::uint32_t cell, const Double3& x) const {
  for (std::uint32_t f = first_face_[cell]; f < first_face_[cell + 1]; ++f) {
    if (!(faces_[f].value(x) < -faces_[f].slack)) return false;
  }
  return true;
}

}  // namespace nef::minkowski

// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/texture/surface.h"

#include <algorithm>

#include "apps/visual_hull/color/photo_view.h"
#include "nef/base/error.h"

namespace nef::visual_hull {

Surface::Surface(const nef::Mesh& mesh) : points_(rounded_points(mesh)) {
  triangles_.reserve(mesh.face_count());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() != 3) throw nef::InputError("a texture needs a mesh of triangles");
    triangles_.push_back({face[0], face[1], face[2]});
  }
  find_sides();
}

void Surface::find_sides() {
  struct Half {
    std::uint32_t from, to, triangle;
    bool operator<(const Half& other) const {
      return std::array{from, to, triangle} < std::array{other.from, other.to, other.triangle};
    }
  };
  std::vector<Half> halves;
  halves.reserve(3 * triangles_.size());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangles_[t][i], triangles_[t][(i + 1) % 3]);
      halves.push_back({low, high, t});
    }
  }
  std::sort(halves.begin(), halves.end());
  for (std::size_t i = 0; i < halves.size(); ++i) {
    for (std::size_t j = i + 1; j < halves.size() && halves[j].from == halves[i].from && halves[j].to == halves[i].to;
         ++j) {
      sides_.push_back({halves[i].from, halves[i].to, {halves[i].triangle, halves[j].triangle}});
    }
  }
  side_begin_.assign(triangles_.size() + 1, 0);
  for (const Side& side : sides_) {
    for (const std::uint32_t t : side.triangles) ++side_begin_[t + 1];
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) side_begin_[t + 1] += side_begin_[t];
  side_list_.resize(side_begin_.back());
  std::vector<std::uint32_t> next = side_begin_;
  for (std::uint32_t s = 0; s < sides_.size(); ++s) {
    for (const std::uint32_t t : sides_[s].triangles) side_list_[next[t]++] = s;
  }
}

std::array<nef::Double3, 3> Surface::corners(std::size_t t) const {
  const auto& [a, b, c] = triangles_[t];
  return {points_[a], points_[b], points_[c]};
}

nef::Double3 Surface::normal(std::size_t t) const {
  const std::array<nef::Double3, 3> at = corners(t);
  return nef::cross(nef::minus(at[1], at[0]), nef::minus(at[2], at[0]));
}

nef::Double3 point_at(const std::array<nef::Double3, 3>& corners, const std::array<double, 3>& weights) {
  nef::Double3 point{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) point[k] += weights[i] * corners[i][k];
  }
  return point;
}

}  // namespace nef::visual_hull

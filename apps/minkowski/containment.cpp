// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/containment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "nef/geometry/box_tree.h"

namespace nef::minkowski {
namespace {

using Vector = std::array<double, 3>;
constexpr double kUnit = 0x1p-53;

// A solid in doubles. All bounds are relative to `size`, the largest coordinate of all cells.
struct Rounded {
  Box box;
  std::vector<Vector> vertices;
  struct Plane {
    Vector normal;  // outwards
    Vector origin;
    double slack;  // value below -slack proves the inside
  };
  std::vector<Plane> planes;
};

// For vertices within 2u*size (nearest doubles are within u relative), two edges a, b of a face of
// extent L have components within e = 8u*size of the truth, so a component of a x b is within
// 2 (2 L e + e^2) + 6u L^2; a third vector of extent M, within e likewise, gives a form within
// 3 (M (4.1 L e + 6u L^2) + 2 L^2 e) + 12u * 6 L^2 M. M is at most 2 size. Any e > L/8 is refused.
Rounded::Plane plane_of(const Vector& o, const Vector& p, const Vector& q, double size) {
  Vector a{};
  Vector b{};
  double extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = p[i] - o[i];
    b[i] = q[i] - p[i];
    extent = std::max({extent, std::fabs(a[i]), std::fabs(b[i])});
  }
  const double e = 8 * kUnit * size;
  const double reach = 2 * size;
  Rounded::Plane plane;
  plane.origin = o;
  plane.normal = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  plane.slack = e * 8 > extent
                    ? std::numeric_limits<double>::infinity()
                    : 1.1 * (3 * (reach * (4.5 * extent * e + 6 * kUnit * extent * extent) + 2 * extent * extent * e) +
                             72 * kUnit * extent * extent * reach) +
                          1e-290;
  return plane;
}

bool inside(const Rounded& cell, const Vector& x) {
  return std::all_of(cell.planes.begin(), cell.planes.end(), [&](const Rounded::Plane& p) {
    const double value =
        p.normal[0] * (x[0] - p.origin[0]) + p.normal[1] * (x[1] - p.origin[1]) + p.normal[2] * (x[2] - p.origin[2]);
    return value < -p.slack;
  });
}

}  // namespace

std::vector<std::uint8_t> held_by_others(std::span<const ConvexCell> cells) {
  std::vector<Rounded> rounded(cells.size());
  double size = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const Rational3& p : cells[i].mesh.vertices) {
      const Vector x = {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
      for (const double value : x) size = std::max(size, std::fabs(value));
      rounded[i].vertices.push_back(x);
      rounded[i].box.add_rounded(x);
    }
  }
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Mesh& mesh = cells[i].mesh;
    for (std::size_t f = 0; cells[i].dimension == 3 && f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      const std::vector<Vector>& v = rounded[i].vertices;
      rounded[i].planes.push_back(plane_of(v[face[0]], v[face[1]], v[face[2]], size));
    }
    boxes.push_back(rounded[i].box);
  }
  // A cell strictly inside another one is smaller, so there are no cycles: every cell that is
  // dropped lies in one that is kept.
  std::vector<std::uint8_t> held(cells.size(), 0);
  const BoxTree tree(boxes);
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const auto around = [&](const Box& box) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (box.low[k] > boxes[i].low[k] || box.high[k] < boxes[i].high[k]) return false;
      }
      return true;
    };
    tree.for_each_if(around, [&](std::uint32_t j) {
      if (held[i] != 0 || j == i || rounded[j].planes.empty()) return;
      const std::vector<Vector>& v = rounded[i].vertices;
      if (std::all_of(v.begin(), v.end(), [&](const Vector& x) { return inside(rounded[j], x); })) held[i] = 1;
    });
  }
  return held;
}

}  // namespace nef::minkowski

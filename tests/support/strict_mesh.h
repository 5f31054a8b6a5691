// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "nef/geometry/vectors.h"
#include "nef/mesh/mesh.h"
#include "nef/number/number.h"

namespace nef::test {

/// What keeps a mesh from being strictly legal, by pairs of triangles and rational arithmetic alone; the empty string
/// if nothing does. Polygons count as fans from their first corner. O(n^2).
class StrictMesh {
 public:
  explicit StrictMesh(const Mesh& mesh) {
    std::map<Rational3, std::uint32_t> number;
    std::vector<std::uint32_t> place;
    for (const Rational3& p : mesh.vertices) {
      const auto [at, added] = number.emplace(p, points_.size());
      place.push_back(at->second);
      if (!added) continue;
      points_.push_back(p);
      doubles_.push_back({nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])});
    }
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        triangles_.push_back({place[face[0]], place[face[i]], place[face[i + 1]]});
      }
    }
  }

  [[nodiscard]] std::string problem() const {
    std::map<std::array<std::uint32_t, 2>, int> balance;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      if (has_no_area(t)) return "triangle " + std::to_string(t) + " has no area";
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t u = triangles_[t][i];
        const std::uint32_t v = triangles_[t][(i + 1) % 3];
        balance[{std::min(u, v), std::max(u, v)}] += u < v ? 1 : -1;
      }
    }
    for (const auto& [edge, sum] : balance) {
      if (sum != 0) return "an edge is open at " + text_of(points_[edge[0]]);
    }
    std::vector<std::array<std::array<double, 2>, 3>> boxes;
    for (const Corners& t : triangles_) {
      std::array<std::array<double, 2>, 3>& box = boxes.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax({doubles_[t[0]][i], doubles_[t[1]][i], doubles_[t[2]][i]});
        box[i] = {low, high};
      }
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t u = t + 1; u < triangles_.size(); ++u) {
        bool apart = false;  // rounding keeps the order of numbers
        for (std::size_t i = 0; i < 3; ++i) apart |= boxes[t][i][1] < boxes[u][i][0] || boxes[u][i][1] < boxes[t][i][0];
        if (!apart && meet(triangles_[t], triangles_[u])) {
          return "triangles " + std::to_string(t) + " and " + std::to_string(u) + " meet near " +
                 text_of(points_[triangles_[t][0]]);
        }
      }
    }
    return "";
  }

 private:
  using Corners = std::array<std::uint32_t, 3>;

  static std::string text_of(const Rational3& p) {
    std::string text;
    for (const Rational& x : p) text += (text.empty() ? "" : " ") + std::to_string(nearest_double(x));
    return text;
  }

  [[nodiscard]] bool has_no_area(std::size_t t) const {
    const Corners& c = triangles_[t];
    const Rational3 n = cross(minus(points_[c[1]], points_[c[0]]), minus(points_[c[2]], points_[c[0]]));
    return n[0] == 0 && n[1] == 0 && n[2] == 0;
  }

  // True if the points of `of` that the other triangle does not share are surely on one side of its plane. With all
  // differences below `size` and coordinates below `reach`, the determinant is off by less than
  // 100 * 2^-53 * size^2 * (size + reach).
  [[nodiscard]] bool surely_beside(const Corners& plane, const Corners& of) const {
    const std::array<double, 3>& o = doubles_[plane[0]];
    const auto from = [&](std::uint32_t v) {
      return std::array<double, 3>{doubles_[v][0] - o[0], doubles_[v][1] - o[1], doubles_[v][2] - o[2]};
    };
    const std::array<double, 3> a = from(plane[1]);
    const std::array<double, 3> b = from(plane[2]);
    int side = 0;
    for (const std::uint32_t v : of) {
      if (std::find(plane.begin(), plane.end(), v) != plane.end()) continue;
      const std::array<double, 3> c = from(v);
      double size = 0;
      double reach = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        size = std::max({size, std::abs(a[i]), std::abs(b[i]), std::abs(c[i])});
        for (const std::uint32_t w : {plane[0], plane[1], plane[2], v})
          reach = std::max(reach, std::abs(doubles_[w][i]));
      }
      const double det =
          a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
      if (!(std::abs(det) > 0x1p-44 * size * size * (size + reach))) return false;
      const int here = det > 0 ? 1 : -1;
      if (side == -here) return false;
      side = here;
    }
    return true;
  }

  // True if the triangles have more in common than the hull of their common corners: an end of what one has of an
  // edge of the other lies beyond it.
  [[nodiscard]] bool meet(const Corners& t, const Corners& u) const {
    std::vector<std::uint32_t> shared;
    for (const std::uint32_t v : t) {
      if (std::find(u.begin(), u.end(), v) != u.end()) shared.push_back(v);
    }
    if (shared.size() == 3) return true;
    if (surely_beside(t, u) || surely_beside(u, t)) return false;
    return edges_meet(t, u, shared) || edges_meet(u, t, shared);
  }

  [[nodiscard]] bool edges_meet(const Corners& t, const Corners& u, const std::vector<std::uint32_t>& shared) const {
    std::array<Rational3, 3> edge;
    for (std::size_t i = 0; i < 3; ++i) edge[i] = minus(points_[u[(i + 1) % 3]], points_[u[i]]);
    const Rational3 normal = cross(edge[0], edge[1]);
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational3& p = points_[t[k]];
      const Rational3& q = points_[t[(k + 1) % 3]];
      // The part [low, high] of p + s (q - p) where all of these linear functions are at least 0.
      Rational low = 0;
      Rational high = 1;
      const auto clip = [&](const Rational& at_p, const Rational& at_q) {
        if (at_p >= 0 && at_q >= 0) return;
        if (at_p < 0 && at_q < 0) {
          high = -1;
          return;
        }
        const Rational s = at_p / (at_p - at_q);
        if (at_p < 0) {
          low = std::max(low, s);
        } else {
          high = std::min(high, s);
        }
      };
      const Rational hp = dot(normal, minus(p, points_[u[0]]));
      const Rational hq = dot(normal, minus(q, points_[u[0]]));
      clip(hp, hq);
      clip(-hp, -hq);
      for (std::size_t i = 0; i < 3 && low <= high; ++i) {
        clip(dot(normal, cross(edge[i], minus(p, points_[u[i]]))),
             dot(normal, cross(edge[i], minus(q, points_[u[i]]))));
      }
      if (low > high) continue;
      for (const Rational& s : {low, high}) {
        Rational3 x = p;
        for (std::size_t i = 0; i < 3; ++i) x[i] += s * (q[i] - p[i]);
        if (!in_hull(x, shared)) return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool in_hull(const Rational3& x, const std::vector<std::uint32_t>& shared) const {
    for (const std::uint32_t v : shared) {
      if (points_[v] == x) return true;
    }
    if (shared.size() < 2) return false;
    const Rational3 along = minus(points_[shared[1]], points_[shared[0]]);
    const Rational3 to = minus(x, points_[shared[0]]);
    const Rational3 off = cross(along, to);
    const Rational at = dot(along, to);
    return off[0] == 0 && off[1] == 0 && off[2] == 0 && at >= 0 && at <= dot(along, along);
  }

  std::vector<Rational3> points_;
  std::vector<std::array<double, 3>> doubles_;
  std::vector<Corners> triangles_;
};

inline std::string not_strictly_legal(const Mesh& mesh) { return StrictMesh(mesh).problem(); }

}  // namespace nef::test

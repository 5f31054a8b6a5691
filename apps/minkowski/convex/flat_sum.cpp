// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convex/flat_sum.h"

#include <algorithm>
#include <array>
#include <span>

#include "nef/construct/convex_hull.h"
#include "nef/geometry/vectors.h"

namespace nef::minkowski {
namespace {

// The mark of the smallest face of a cell that holds the given vertices, which are those of a face.
bool face_mark(const ConvexCell& cell, std::vector<std::uint32_t> vertices) {
  if (cell.boundary == ConvexCell::Boundary::kClosed) return true;
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  if (cell.dimension == 0) return true;
  if (vertices.size() == 1) return cell.vertex_marked(vertices[0]);
  if (cell.dimension == 1) return true;
  for (std::size_t f = 0; f < cell.mesh.face_count(); ++f) {
    const auto face = cell.mesh.face(f);
    if (vertices.size() == 2) {
      for (std::size_t k = 0; k < face.size(); ++k) {
        const std::uint32_t from = face[k];
        const std::uint32_t to = face[(k + 1) % face.size()];
        if (std::min(from, to) == vertices[0] && std::max(from, to) == vertices[1]) {
          return cell.edge_marked(cell.mesh.face_begin[f] + k);
        }
      }
    } else if (face.size() == vertices.size() && std::all_of(face.begin(), face.end(), [&](std::uint32_t v) {
                 return std::binary_search(vertices.begin(), vertices.end(), v);
               })) {
      return cell.dimension == 2 || cell.facet_marked(f);
    }
  }
  return true;  // no proper face: the cell itself
}

}  // namespace

// A face of the sum is the sum of the two faces
// whose vertices make its vertices.
ConvexCell flat_sum(const ConvexCell& c, const ConvexCell& d, const Monitor& monitor) {
  std::vector<Rational3> points;
  points.reserve(c.mesh.vertices.size() * d.mesh.vertices.size());
  for (const Rational3& p : c.mesh.vertices) {
    for (const Rational3& q : d.mesh.vertices) points.push_back(plus(p, q));
  }
  Hull hull = hull_of(points, monitor);
  ConvexCell sum;
  sum.dimension = hull.dimension;
  sum.mesh = std::move(hull.mesh);
  if (c.boundary == ConvexCell::Boundary::kClosed && d.boundary == ConvexCell::Boundary::kClosed) return sum;

  sum.boundary = ConvexCell::Boundary::kMixed;
  const std::size_t width = d.mesh.vertices.size();
  const auto mark = [&](std::span<const std::uint32_t> vertices) -> std::uint8_t {
    std::vector<std::uint32_t> of_c;
    std::vector<std::uint32_t> of_d;
    for (const std::uint32_t v : vertices) {
      of_c.push_back(static_cast<std::uint32_t>(hull.source[v] / width));
      of_d.push_back(static_cast<std::uint32_t>(hull.source[v] % width));
    }
    return face_mark(c, std::move(of_c)) && face_mark(d, std::move(of_d)) ? 1 : 0;
  };
  if (sum.dimension == 0) {
    sum.boundary = ConvexCell::Boundary::kClosed;  // a relatively open point is the point
    return sum;
  }
  for (std::uint32_t v = 0; v < sum.mesh.vertices.size(); ++v) sum.vertex_marks.push_back(mark({&v, 1}));
  for (std::size_t f = 0; f < sum.mesh.face_count(); ++f) {
    const auto face = sum.mesh.face(f);
    if (sum.dimension == 3) sum.facet_marks.push_back(mark(face));
    for (std::size_t k = 0; k < face.size(); ++k) {
      const std::array<std::uint32_t, 2> edge = {face[k], face[(k + 1) % face.size()]};
      sum.edge_marks.push_back(mark(edge));
    }
  }
  return sum;
}

}  // namespace nef::minkowski

// SPDX-License-Identifier: Apache-2.0
//
// Corners of cubes are multiples of a side that is a small number times a power of two, so doubles represent them
// exactly. The number of cubes is proportional to the number of items. Edges enter cubes slab by slab along their
// longest axis. A facet enters the cubes of its edges; of the other cubes in its box, those that its plane crosses are
// decided by one point of the plane in the cube, by parity among the edges. Every comparison has a margin above its
// rounding errors, towards "entered".
#include "apps/planner/free_space/empty_grid.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "nef/complex/facet_plane.h"
#include "nef/complex/item_boxes.h"

namespace nef::planner {
namespace {

// Cubes for each item; more find narrower ways, and cost more.
constexpr std::size_t kCubesPerItem = 3;
constexpr std::size_t kFewest = 1U << 16U;
constexpr std::size_t kMost = 1U << 18U;

// The largest m 2^k, 4 <= m < 8, not above x > 0.
double short_number_below(double x) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);  // in [1/2, 1)
  return std::ldexp(std::floor(fraction * 8), exponent - 3);
}

// The edges of a facet as doubles.
class FacetEdges {
 public:
  using Ends = std::array<std::array<double, 3>, 2>;

  FacetEdges(const Complex& complex, const Facet& facet) {
    const PlaneAxes axes(complex.planes, facet.plane);
    u_ = static_cast<std::size_t>(axes.first);
    v_ = static_cast<std::size_t>(axes.second);
    const std::span<const SHalfedgeId> corners = complex.corners_of(facet);
    ends_.reserve(corners.size());
    for (const SHalfedgeId corner : corners) {
      const HalfedgeId halfedge = complex.corner_halfedge(corner);
      ends_.push_back({complex.points.approximate(point_of(complex.source(halfedge))),
                       complex.points.approximate(point_of(complex.target(halfedge)))});
    }
  }

  [[nodiscard]] const std::vector<Ends>& ends() const { return ends_; }
  /// True if a point of the plane, not near an edge, is in the facet.
  [[nodiscard]] bool surround(const Vector3d& x) const {
    const double xu = x[static_cast<Eigen::Index>(u_)];
    const double xv = x[static_cast<Eigen::Index>(v_)];
    bool inside = false;
    for (const auto& [a, b] : ends_) {
      if ((a[v_] > xv) != (b[v_] > xv) && a[u_] + (xv - a[v_]) / (b[v_] - a[v_]) * (b[u_] - a[u_]) > xu) {
        inside = !inside;
      }
    }
    return inside;
  }

 private:
  std::vector<Ends> ends_;
  std::size_t u_ = 0;
  std::size_t v_ = 0;
};

}  // namespace

EmptyGrid::EmptyGrid(const Complex& complex, const Monitor& monitor) {
  Box all;
  for (const VertexId v : complex.vertex_ids()) all.add_rounded(complex.points.approximate(point_of(v)));
  if (complex.vertex_count() == 0) return;
  const std::size_t items = complex.vertex_count() + complex.edge_count() + complex.facet_count();
  choose_cubes(all.low, all.high, std::clamp(kCubesPerItem * items, kFewest, kMost));
  if (entered_.empty()) return;
  enter_rim();
  for (const Facet& facet : complex.facets) {
    monitor.check_interruption();
    enter(complex, facet);
  }
  for (const HalfedgeId h : complex.halfedge_ids()) {
    if (complex.twin[h] < h || complex.svertex(h).out != kNone) continue;
    enter_edge(complex.points.approximate(point_of(complex.source(h))),
               complex.points.approximate(point_of(complex.target(h))));
  }
  for (const VertexId v : complex.vertex_ids()) {
    if (!complex.sphere_map(v).svertices.empty()) continue;
    const Box box = vertex_box(complex, v);
    enter_box(box.low, box.high);
  }
}

bool EmptyGrid::is_rim(std::uint32_t index) const {
  const Cube at = cube(index);
  for (std::size_t k = 0; k < 3; ++k) {
    if (at[k] == 0 || at[k] + 1 == counts_[k]) return true;
  }
  return false;
}

// Row by row: whole ones at the rim of the rows, and both ends of the others.
void EmptyGrid::enter_rim() {
  for (std::uint32_t z = 0; z < counts_[2]; ++z) {
    for (std::uint32_t y = 0; y < counts_[1]; ++y) {
      const auto row = entered_.begin() + static_cast<std::ptrdiff_t>(index({0, y, z}));
      if (y == 0 || y + 1 == counts_[1] || z == 0 || z + 1 == counts_[2]) {
        std::fill_n(row, counts_[0], std::uint8_t{1});
      }
      row[0] = row[counts_[0] - 1] = 1;
    }
  }
}

// Two cubes more than needed on either side.
void EmptyGrid::choose_cubes(const std::array<double, 3>& low, const std::array<double, 3>& high, std::size_t wanted) {
  double product = 1;
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) longest = std::max(longest, high[i] - low[i]);
  for (std::size_t i = 0; i < 3; ++i) product *= std::max(high[i] - low[i], longest / 64);
  const double side = short_number_below(std::cbrt(product / static_cast<double>(wanted)));
  double total = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const double first = std::floor(low[i] / side) - 2;
    const double last = std::floor(high[i] / side) + 3;
    // Exact multiples of the side need few bits; this also turns down what is not a number.
    if (!(std::fabs(first) < 0x1p40 && std::fabs(last) < 0x1p40)) return;
    low_[i] = first * side;
    counts_[i] = static_cast<std::uint32_t>(last - first);
    total *= last - first;
  }
  if (!(total <= 8.0 * static_cast<double>(kMost)) || !std::isnormal(side) || side < 1e-280) return;
  side_ = side;
  entered_.assign(static_cast<std::size_t>(total), 0);
}

// Cubes that hold a coordinate in their closed range, and the next ones where it is within 2^-10 of a side of them:
// far more than doubles round.
std::array<EmptyGrid::Cube, 2> EmptyGrid::range(const std::array<double, 3>& low,
                                                const std::array<double, 3>& high) const {
  std::array<Cube, 2> result;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr double kSlack = 0x1p-10;
    const double first = std::floor((low[i] - low_[i]) / side_ - kSlack);
    const double last = std::floor((high[i] - low_[i]) / side_ + kSlack);
    const double most = counts_[i] - 1.0;
    result[0][i] = static_cast<std::uint32_t>(std::clamp(first, 0.0, most));
    result[1][i] = static_cast<std::uint32_t>(std::clamp(last, 0.0, most));
  }
  return result;
}

void EmptyGrid::enter_box(const std::array<double, 3>& low, const std::array<double, 3>& high) {
  const auto [first, last] = range(low, high);
  for (std::uint32_t z = first[2]; z <= last[2]; ++z) {
    for (std::uint32_t y = first[1]; y <= last[1]; ++y) {
      for (std::uint32_t x = first[0]; x <= last[0]; ++x) entered_[index({x, y, z})] = 1;
    }
  }
}

// Slab by slab along the axis in which the edge is longest.
void EmptyGrid::enter_edge(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::fabs(b[i] - a[i]) > std::fabs(b[axis] - a[axis])) axis = i;
  }
  const std::array<double, 3>& low = a[axis] <= b[axis] ? a : b;
  const std::array<double, 3>& high = a[axis] <= b[axis] ? b : a;
  const double length = high[axis] - low[axis];
  const auto [first, last] = range(low, high);  // along the axis only
  for (std::uint32_t i = first[axis]; i <= last[axis]; ++i) {
    std::array<double, 3> from = low;
    std::array<double, 3> to = high;
    if (length > 0) {
      // A hair more than the slab.
      const double begin = low_[axis] + (i - 0x1p-9) * side_;
      const double end = low_[axis] + (i + 1 + 0x1p-9) * side_;
      const double s = std::clamp((begin - low[axis]) / length, 0.0, 1.0);
      const double t = std::clamp((end - low[axis]) / length, 0.0, 1.0);
      for (std::size_t k = 0; k < 3; ++k) {
        from[k] = low[k] + s * (high[k] - low[k]);
        to[k] = low[k] + t * (high[k] - low[k]);
      }
    }
    std::array<double, 3> least;
    std::array<double, 3> most;
    for (std::size_t k = 0; k < 3; ++k) {
      least[k] = std::min(from[k], to[k]);
      most[k] = std::max(from[k], to[k]);
    }
    enter_box(least, most);
  }
}

// A facet enters the cubes that its edges enter. Of the others in its box, those whose corners its plane parts, with a
// margin for the rounding of coefficients, coordinates and sums, meet it or not with all that the plane has in them;
// a point of that, which is farther from all edges than doubles round, tells.
void EmptyGrid::enter(const Complex& complex, const Facet& facet) {
  const Box box = facet_box(complex, facet);
  const auto [first, last] = range(box.low, box.high);
  std::size_t in_box = 1;
  for (std::size_t i = 0; i < 3; ++i) in_box *= last[i] - first[i] + 1;
  // A small one may as well enter all that its plane parts.
  constexpr std::size_t kSmall = 64;
  std::optional<FacetEdges> edges;
  if (in_box > kSmall) {
    edges.emplace(complex, facet);
    for (const auto& [a, b] : edges->ends()) enter_edge(a, b);
  }
  const std::array<double, 4>& n = complex.planes.approximate(facet.plane);
  const Vector3d normal(n[0], n[1], n[2]);
  const Vector3d reach = normal.cwiseSign() * (side_ / 2);  // to the corner with the largest form
  const double half = normal.dot(reach);
  for (std::uint32_t z = first[2]; z <= last[2]; ++z) {
    for (std::uint32_t y = first[1]; y <= last[1]; ++y) {
      for (std::uint32_t x = first[0]; x <= last[0]; ++x) {
        if (!is_empty(index({x, y, z}))) continue;
        const Vector3d c = centre({x, y, z});
        const double value = normal.dot(c) + n[3];
        const double size = normal.cwiseAbs().dot(c.cwiseAbs()) + std::fabs(n[3]) + half;
        if (std::fabs(value) > half + 0x1p-44 * size) continue;
        const bool met = !edges || edges->surround(c - std::clamp(value / half, -1.0, 1.0) * reach);
        if (met) entered_[index({x, y, z})] = 1;
      }
    }
  }
}

EmptyGrid::Cube EmptyGrid::nearest(const Vector3d& point) const {
  Cube result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double at = std::floor((point[static_cast<Eigen::Index>(i)] - low_[i]) / side_);
    result[i] = static_cast<std::uint32_t>(std::clamp(at, 0.0, counts_[i] - 1.0));
  }
  return result;
}

Vector3d EmptyGrid::centre(const Cube& cube) const {
  Vector3d result;
  for (std::size_t i = 0; i < 3; ++i) result[static_cast<Eigen::Index>(i)] = low_[i] + (cube[i] + 0.5) * side_;
  return result;
}

}  // namespace nef::planner

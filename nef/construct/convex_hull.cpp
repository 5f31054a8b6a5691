// SPDX-License-Identifier: Apache-2.0
//
// Quickhull with conflict lists on a triangulated surface. A face is visible only from points
// strictly above it, so points on its plane never break it; coplanar triangles are merged at the
// end, by identity of their interned planes. With strict visibility a point that loses its triangle
// and is still outside lies strictly above one of the new triangles: the way from the lost
// triangle to the point leaves the new hull through a place that the old hull does not contain.
#include "nef/construct/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "nef/base/error.h"
#include "nef/construct/planar_hull.h"
#include "nef/geometry/plane_finder.h"
#include "nef/geometry/predicates.h"
#include "nef/geometry/vectors.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

constexpr std::uint32_t kNobody = 0xffffffffU;

struct HullTriangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<std::uint32_t, 3> across{};  // the triangle beyond the edge vertex[i], vertex[i+1]
  std::vector<std::uint32_t> outside;     // points strictly above that were given to this triangle
  std::uint32_t farthest = kNobody;
  double height = -1;
  PlaneId plane;  // oriented outwards; interned when the filter first fails
  bool alive = true;
};

class Quickhull {
 public:
  Quickhull(std::span<const Rational3> points, const Monitor& monitor) : points_(points), monitor_(monitor) {
    table_.reserve(points.size());
    for (const Rational3& p : points) {
      const PointId id = table_.push(p);
      for (const double x : table_.approximate(id)) largest_ = std::max(largest_, std::fabs(x));
    }
  }

  Hull run();

 private:
  // The points that span the hull's affine hull: 1 to 4 of them.
  std::vector<std::uint32_t> span();
  void start(const std::vector<std::uint32_t>& simplex);
  void add_point(std::uint32_t triangle);
  void find_visible(std::uint32_t triangle, std::uint32_t point);
  void cone(std::uint32_t point);
  void hand_out(std::uint32_t point, std::uint32_t first_triangle);
  Approximation orient(const HullTriangle& t, std::uint32_t point) const;
  // No plane if they are on one line.
  PlaneId plane_through(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return finder_.through(planes_, table_, PointId(a), PointId(b), PointId(c));
  }
  [[nodiscard]] int side_of(PlaneId plane, std::uint32_t point) const {
    return side_of_plane(planes_, plane, table_, PointId(point), monitor_);
  }
  PlaneId plane_of(HullTriangle& t);
  bool above(HullTriangle& t, std::uint32_t point, double& height);
  Hull flat_hull(const std::vector<std::uint32_t>& simplex) const;
  Hull merge();

  [[nodiscard]] const std::array<double, 3>& approximate(std::uint32_t i) const {
    return table_.approximate(PointId(i));
  }

  std::span<const Rational3> points_;
  Monitor monitor_;
  PointTable table_;
  PlaneTable planes_;
  PlaneFinder finder_;
  double largest_ = 0;
  std::vector<HullTriangle> triangles_;
  std::vector<std::uint32_t> todo_;  // triangles that may have points outside
  std::vector<std::uint32_t> visible_;
  std::vector<std::uint32_t> seen_;  // per triangle: the point it was last tested with
  std::vector<std::uint32_t> orphans_;
};

// Six times the volume of the tetrahedron, positive above the triangle, and a bound of its error.
//
// u = 2^-53. A coordinate is within 4u of the truth, relatively, so a difference of two has an
// absolute error of at most e = 10uM, M the largest coordinate, rounding included. For differences
// of at most D the determinant's six products of three change by less than 6 * 3 D^2 e (1 + 1/32)
// if e <= D/64, and evaluating it rounds by less than 6 * 8u D^3. Hence 20 D^2 e + 64u D^3. Below 1e100 no product
// overflows. What underflows, in coordinates or in products of two, is off by 2^-1074 and is multiplied by D^2 or D: up
// to D = 1 that is far below the last term, beyond far below the others.
Approximation Quickhull::orient(const HullTriangle& t, std::uint32_t point) const {
  const std::array<double, 3>& o = approximate(t.vertex[0]);
  std::array<std::array<double, 3>, 3> d{};
  double extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    d[0][i] = approximate(t.vertex[1])[i] - o[i];
    d[1][i] = approximate(t.vertex[2])[i] - o[i];
    d[2][i] = approximate(point)[i] - o[i];
    extent = std::max({extent, std::fabs(d[0][i]), std::fabs(d[1][i]), std::fabs(d[2][i])});
  }
  constexpr double kUnit = kRoundingUnit;
  const double error = 10 * kUnit * largest_;
  const double bound = error * 64 <= extent && extent < 1e100
                           ? 20 * extent * extent * error + 64 * kUnit * extent * extent * extent + 1e-290
                           : std::numeric_limits<double>::infinity();
  const double value = d[2][0] * (d[0][1] * d[1][2] - d[0][2] * d[1][1]) +
                       d[2][1] * (d[0][2] * d[1][0] - d[0][0] * d[1][2]) +
                       d[2][2] * (d[0][0] * d[1][1] - d[0][1] * d[1][0]);
  return {value, bound};
}

PlaneId Quickhull::plane_of(HullTriangle& t) {
  if (!t.plane.valid()) t.plane = plane_through(t.vertex[0], t.vertex[1], t.vertex[2]);
  return t.plane;
}

// `height` is only for choosing a far point.
bool Quickhull::above(HullTriangle& t, std::uint32_t point, double& height) {
  const Approximation rough = orient(t, point);
  height = rough.value;
  return sign_by_ladder(rough, monitor_, [&] { return side_of(plane_of(t), point); }) > 0;
}

std::vector<std::uint32_t> Quickhull::span() {
  std::vector<std::uint32_t> simplex;
  if (points_.empty()) return simplex;
  simplex.push_back(0);
  // Each next point is the one that doubles show farthest off; if that is not exactly off, every
  // point is asked, since doubles may show anything for points that all but lie there.
  const auto extend = [&](auto&& distance, auto&& off) {
    std::uint32_t best = 0;
    double most = -1;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const double value = distance(approximate(i));
      if (value > most) {
        most = value;
        best = i;
      }
    }
    if (off(best)) {
      simplex.push_back(best);
      return true;
    }
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (off(i)) {
        simplex.push_back(i);
        return true;
      }
    }
    return false;
  };
  const Double3 o = approximate(0);
  if (!extend([&](const Double3& p) { return dot(minus(p, o), minus(p, o)); },
              [&](std::uint32_t i) { return points_[i] != points_[0]; })) {
    return simplex;
  }
  const Double3 d = minus(approximate(simplex[1]), o);
  if (!extend(
          [&](const Double3& p) {
            const Double3 n = cross(d, minus(p, o));
            return dot(n, n);
          },
          [&](std::uint32_t i) { return plane_through(0, simplex[1], i).valid(); })) {
    return simplex;
  }
  const Double3 n = cross(d, minus(approximate(simplex[2]), o));
  const PlaneId plane = plane_through(0, simplex[1], simplex[2]);
  extend([&](const Double3& p) { return std::fabs(dot(n, minus(p, o))); },
         [&](std::uint32_t i) { return side_of(plane, i) != 0; });
  return simplex;
}

void Quickhull::start(const std::vector<std::uint32_t>& simplex) {
  std::array<std::uint32_t, 4> v = {simplex[0], simplex[1], simplex[2], simplex[3]};
  // The fourth point is to lie below the first three.
  if (side_of(plane_through(v[0], v[1], v[2]), v[3]) > 0) std::swap(v[1], v[2]);
  constexpr std::array<std::array<std::uint32_t, 3>, 4> kFaces = {{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
  triangles_.resize(4);
  for (std::uint32_t f = 0; f < 4; ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      triangles_[f].vertex[i] = v[kFaces[f][i]];
      const std::uint32_t from = kFaces[f][i];
      const std::uint32_t to = kFaces[f][(i + 1) % 3];
      for (std::uint32_t g = 0; g < 4; ++g) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (kFaces[g][k] == to && kFaces[g][(k + 1) % 3] == from) triangles_[f].across[i] = g;
        }
      }
    }
    todo_.push_back(f);
  }
  seen_.assign(4, kNobody);
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if (std::find(v.begin(), v.end(), i) == v.end()) hand_out(i, 0);
  }
}

// Gives a point to the first triangle from `first_triangle` on that it lies above; forgets it if there is none.
void Quickhull::hand_out(std::uint32_t point, std::uint32_t first_triangle) {
  for (std::uint32_t f = first_triangle; f < triangles_.size(); ++f) {
    HullTriangle& t = triangles_[f];
    double height = 0;
    if (!above(t, point, height)) continue;
    t.outside.push_back(point);
    if (t.farthest == kNobody || height > t.height) {
      t.height = height;
      t.farthest = point;
    }
    return;
  }
}

void Quickhull::find_visible(std::uint32_t triangle, std::uint32_t point) {
  visible_.assign(1, triangle);
  triangles_[triangle].alive = false;
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    const std::array<std::uint32_t, 3> across = triangles_[visible_[k]].across;
    for (const std::uint32_t g : across) {
      if (!triangles_[g].alive || seen_[g] == point) continue;
      seen_[g] = point;
      double height = 0;
      if (above(triangles_[g], point, height)) {
        triangles_[g].alive = false;
        visible_.push_back(g);
      }
    }
  }
}

// Replaces the visible triangles by the cone from the point over their horizon.
void Quickhull::cone(std::uint32_t point) {
  const auto first = static_cast<std::uint32_t>(triangles_.size());
  std::unordered_map<std::uint32_t, std::uint32_t>
      leaving;  // horizon vertex -> new triangle on the edge that starts there
  for (const std::uint32_t f : visible_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t beyond = triangles_[f].across[i];
      if (!triangles_[beyond].alive) continue;
      const auto fresh = static_cast<std::uint32_t>(triangles_.size());
      const std::uint32_t from = triangles_[f].vertex[i];
      const std::uint32_t to = triangles_[f].vertex[(i + 1) % 3];
      HullTriangle& other = triangles_[beyond];
      for (std::size_t k = 0; k < 3; ++k) {
        if (other.vertex[k] == to) other.across[k] = fresh;
      }
      leaving[from] = fresh;
      HullTriangle& t = triangles_.emplace_back();
      t.vertex = {from, to, point};
      t.across[0] = beyond;
    }
  }
  for (std::uint32_t f = first; f < triangles_.size(); ++f) {
    const std::uint32_t next = leaving.at(triangles_[f].vertex[1]);
    triangles_[f].across[1] = next;
    triangles_[next].across[2] = f;
    todo_.push_back(f);
  }
  seen_.resize(triangles_.size(), kNobody);
  orphans_.clear();
  for (const std::uint32_t f : visible_) {
    for (const std::uint32_t p : triangles_[f].outside) {
      if (p != point) orphans_.push_back(p);
    }
    triangles_[f].outside = {};
  }
  for (const std::uint32_t p : orphans_) hand_out(p, first);
}

void Quickhull::add_point(std::uint32_t triangle) {
  const std::uint32_t point = triangles_[triangle].farthest;
  find_visible(triangle, point);
  cone(point);
}

Hull Quickhull::flat_hull(const std::vector<std::uint32_t>& simplex) const {
  Hull hull;
  hull.dimension = static_cast<int>(simplex.size()) - 1;
  if (simplex.size() < 2) {
    hull.source = simplex;
  } else {
    const Rational3 d = minus(points_[simplex[1]], points_[simplex[0]]);
    hull.source = simplex.size() == 2
                      ? detail::linear_hull(points_, d)
                      : detail::planar_hull(points_, cross(d, minus(points_[simplex[2]], points_[simplex[0]])));
  }
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t i : hull.source) {
    corners.push_back(static_cast<std::uint32_t>(corners.size()));
    hull.mesh.vertices.push_back(points_[i]);
  }
  if (hull.dimension == 2) hull.mesh.push_face(corners);
  return hull;
}

// Unites coplanar triangles to faces. What is left in the middle of a face or of an edge (around
// which there are fewer than three planes) is no vertex of the hull.
Hull Quickhull::merge() {
  Hull hull;
  hull.dimension = 3;
  std::unordered_map<std::uint32_t, std::vector<std::array<std::uint32_t, 2>>> boundary;  // per plane: edges
  std::vector<std::uint32_t> order;                                                       // planes as they come
  std::vector<std::uint32_t> planes_around(points_.size(), 0);
  for (HullTriangle& t : triangles_) {
    if (!t.alive) continue;
    const PlaneId plane = plane_of(t);
    for (std::size_t i = 0; i < 3; ++i) {
      if (plane_of(triangles_[t.across[i]]) == plane) continue;
      std::vector<std::array<std::uint32_t, 2>>& edges = boundary[plane.value];
      if (edges.empty()) order.push_back(plane.value);
      edges.push_back({t.vertex[i], t.vertex[(i + 1) % 3]});
      ++planes_around[t.vertex[i]];  // one boundary edge of each plane starts here
    }
  }
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  std::unordered_map<std::uint32_t, std::uint32_t> next;
  std::vector<std::uint32_t> face;
  for (const std::uint32_t plane : order) {
    const std::vector<std::array<std::uint32_t, 2>>& edges = boundary[plane];
    next.clear();
    for (const auto& [from, to] : edges) next[from] = to;
    face.clear();
    std::uint32_t v = edges[0][0];
    for (std::size_t k = 0; k < edges.size(); ++k, v = next[v]) {
      if (planes_around[v] < 3) continue;
      const auto [it, is_new] = number.try_emplace(v, static_cast<std::uint32_t>(hull.source.size()));
      if (is_new) {
        hull.source.push_back(v);
        hull.mesh.vertices.push_back(points_[v]);
      }
      face.push_back(it->second);
    }
    hull.mesh.push_face(face);
  }
  return hull;
}

Hull Quickhull::run() {
  const std::vector<std::uint32_t> simplex = span();
  if (simplex.size() < 4) return flat_hull(simplex);
  start(simplex);
  while (!todo_.empty()) {
    const std::uint32_t f = todo_.back();
    todo_.pop_back();
    if (triangles_[f].alive && triangles_[f].farthest != kNobody) add_point(f);
  }
  return merge();
}

}  // namespace

Hull hull_of(std::span<const Rational3> points, const Monitor& monitor) { return Quickhull(points, monitor).run(); }

Mesh convex_hull_mesh(std::span<const Rational3> points, const Monitor& monitor) {
  Hull hull = hull_of(points, monitor);
  if (hull.dimension < 3) {
    constexpr std::array<const char*, 4> kNames = {"are none", "are one point", "lie on a line", "lie in a plane"};
    const int name = hull.dimension + 1;
    throw InputError(std::string("the convex hull of points that ") + kNames[static_cast<std::size_t>(name)] +
                     " is not a solid: give four points that do not lie in a plane");
  }
  return std::move(hull.mesh);
}

Polyhedron convex_hull(std::span<const Rational3> points, const Monitor& monitor) {
  Hull hull = hull_of(points, monitor);
  switch (hull.dimension) {
    case -1:
      return {};
    case 0:
      return make_point(hull.mesh.vertices[0], monitor);
    case 1:
      return make_segment(hull.mesh.vertices[0], hull.mesh.vertices[1], monitor);
    case 2:
      return make_polygon(std::span<const std::vector<Rational3>>(&hull.mesh.vertices, 1), monitor);
    default:
      return from_mesh(hull.mesh, MeshOptions{.strict = true, .as_surface = false, .check = false, .monitor = monitor});
  }
}

}  // namespace nef

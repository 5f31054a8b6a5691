// SPDX-License-Identifier: Apache-2.0
//
// Branch and bound, in each direction. The distance from a triangle to the other surface is at most the largest
// distance of its corners to any one triangle there, since the distance to a convex set is a convex function, and at
// least the distance of any of its points. The part with the largest upper bound is halved until the bounds agree to a
// hundredth or the splits are used up. Nearest triangles are found in a tree of boxes, beginning with the triangle that
// was nearest to the parent. Rounding errors are bounded once by `slack_` and added to the bounds.
#include "apps/remeshing/hausdorff.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <queue>
#include <string>
#include <vector>

#include "nef/base/error.h"
#include "nef/export/nearest_float.h"
#include "nef/geometry/search/box_tree.h"

namespace nef {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;

// The point of a triangle nearest to p up to rounding, as weights of its corners: not negative, with a sum of 1 up to
// rounding. By the Voronoi regions of corners, sides and face [Ericson 2005, 5.1.5].
Vector3d nearest_weights(const Triangle& t, const Vector3d& p) {
  const Vector3d ab = t[1] - t[0];
  const Vector3d ac = t[2] - t[0];
  const Vector3d ap = p - t[0];
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vector3d bp = p - t[1];
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const Vector3d cp = p - t[2];
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const auto share = [](double x, double y) { return x + y > 0 ? std::clamp(x / (x + y), 0.0, 1.0) : 0.0; };
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - share(d1, -d3), share(d1, -d3), 0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - share(d2, -d6), 0, share(d2, -d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return {0, 1 - share(d4 - d3, d5 - d6), share(d4 - d3, d5 - d6)};
  const double v = std::clamp(vb / (va + vb + vc), 0.0, 1.0);
  const double w = std::clamp(vc / (va + vb + vc), 0.0, 1.0 - v);
  return {1 - v - w, v, w};
}

Vector3d at(const Triangle& t, const Vector3d& weights) {
  return weights[0] * t[0] + weights[1] * t[1] + weights[2] * t[2];
}

// Distances from points to a surface, as bounds. All coordinates are at most `size`; what is computed here from them
// with a dozen roundings, a weight that is off by three units in the last place, and the coordinates, which are the
// nearest doubles of rationals, are each within 32 * 2^-53 * size of the truth.
class Surface {
 public:
  Surface(const Mesh& mesh, double size) : slack_(0x1p-48 * size) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      Triangle& triangle = triangles_.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Rational3& p = mesh.vertices[mesh.face(f)[i]];
        triangle[i] = {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
      }
    }
    std::vector<Box> boxes(triangles_.size());
    for (std::size_t f = 0; f < boxes.size(); ++f) {
      for (const Vector3d& p : triangles_[f]) boxes[f].add_rounded({p[0], p[1], p[2]});
    }
    tree_ = BoxTree(boxes);
  }

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

  struct Nearest {
    DistanceBounds distance;
    std::size_t triangle = 0;
  };

  // `guess` is a triangle that may be near.
  [[nodiscard]] Nearest nearest(const Vector3d& p, std::size_t guess) const {
    Nearest best{{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, guess};
    const auto meet = [&](std::size_t f) {
      const Vector3d gap = p - at(triangles_[f], nearest_weights(triangles_[f], p));
      const double length = gap.norm();
      // All of the triangle lies beyond the plane through its nearest point that is normal to the gap; whatever
      // direction rounding made of it, that it lies beyond a plane is computed for that direction.
      double beyond = length;
      if (length > 0) {
        for (const Vector3d& corner : triangles_[f]) beyond = std::min(beyond, gap.dot(p - corner) / length);
      }
      best.distance.low = std::min(best.distance.low, std::max(0.0, beyond - slack_));
      if (length + slack_ < best.distance.high) {
        best.distance.high = length + slack_;
        best.triangle = f;
      }
    };
    meet(guess);
    tree_.for_each_if([&](const Box& box) { return distance_to(box, p) <= best.distance.high; },
                      [&](std::uint32_t f) { meet(f); });
    return best;
  }

  // How far the corners of a triangle, and so all of it, are at most from one triangle of the surface: the distance to
  // a convex set is a convex function.
  [[nodiscard]] double farthest(const Triangle& triangle, std::size_t f) const {
    double result = 0;
    for (const Vector3d& p : triangle) {
      result = std::max(result, (p - at(triangles_[f], nearest_weights(triangles_[f], p))).norm() + slack_);
    }
    return result;
  }

 private:
  [[nodiscard]] double distance_to(const Box& box, const Vector3d& p) const {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double gap = std::max({0.0, box.low[k] - p[i], p[i] - box.high[k]});
      sum += gap * gap;
    }
    return std::sqrt(sum) - slack_;
  }

  double slack_;
  std::vector<Triangle> triangles_;
  BoxTree tree_;
};

// A part of one surface, and how far it is from the other at most.
struct Part {
  Triangle corners;
  double drift = 0;  // how far rounded middles have moved it at most
  double high = 0;
  std::size_t near = 0;  // a triangle of the other surface
  bool operator<(const Part& other) const { return high < other.high; }
};

class Comparison {
 public:
  explicit Comparison(double size) : rounding_(0x1p-52 * size) {}

  void add(const Surface& from, const Surface& to, std::size_t splits) {
    std::priority_queue<Part> parts;
    for (const Triangle& triangle : from.triangles()) parts.push(part_of(triangle, 0, to, 0));
    for (; !close_enough(parts.top().high) && splits > 0; --splits) {
      const Part part = parts.top();
      parts.pop();
      for (const Triangle& half : halves(part.corners)) {
        parts.push(part_of(half, part.drift + rounding_, to, part.near));
      }
    }
    bounds_.high = std::max(bounds_.high, parts.top().high);
  }

  [[nodiscard]] DistanceBounds bounds() const { return bounds_; }

 private:
  [[nodiscard]] bool close_enough(double high) const { return high <= 1.01 * bounds_.low; }

  // The corners, and the centre, each know a triangle of the other surface that may be near all of the part.
  Part part_of(const Triangle& triangle, double drift, const Surface& to, std::size_t guess) {
    Part part{triangle, drift, std::numeric_limits<double>::infinity(), guess};
    const Vector3d centre = (triangle[0] + triangle[1] + triangle[2]) / 3;
    for (const Vector3d& p : {triangle[0], triangle[1], triangle[2], centre}) {
      const Surface::Nearest nearest = to.nearest(p, guess);
      bounds_.low = std::max(bounds_.low, nearest.distance.low - drift - rounding_);
      consider(part, to, nearest.triangle);
    }
    return part;
  }

  static void consider(Part& part, const Surface& to, std::size_t f) {
    const double high = to.farthest(part.corners, f) + part.drift;
    if (high >= part.high) return;
    part.high = high;
    part.near = f;
  }

  // At the middle of the longest side.
  static std::array<Triangle, 2> halves(const Triangle& t) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if ((t[i] - t[(i + 1) % 3]).squaredNorm() > (t[longest] - t[(longest + 1) % 3]).squaredNorm()) longest = i;
    }
    const Vector3d& a = t[longest];
    const Vector3d& b = t[(longest + 1) % 3];
    const Vector3d& c = t[(longest + 2) % 3];
    const Vector3d middle = (a + b) / 2;
    return {Triangle{a, middle, c}, Triangle{middle, b, c}};
  }

  double rounding_;  // of a middle
  DistanceBounds bounds_;
};

double largest_coordinate(const Mesh& mesh) {
  double size = 0;
  for (const Rational3& p : mesh.vertices) {
    for (const Rational& x : p) size = std::max(size, std::abs(nearest_double(x)));
  }
  return size;
}

// The exponent of the largest coordinate: about its logarithm to base 2.
long exponent_of(const Mesh& mesh) {
  long exponent = std::numeric_limits<long>::min();
  for (const Rational3& p : mesh.vertices) {
    for (const Rational& x : p) {
      if (x == 0) continue;
      const auto bits = static_cast<long>(mpz_sizeinbase(x.get_num_mpz_t(), 2));
      exponent = std::max(exponent, bits - static_cast<long>(mpz_sizeinbase(x.get_den_mpz_t(), 2)));
    }
  }
  return exponent;
}

// Times 2^exponent.
Mesh scaled(Mesh mesh, long exponent) {
  const auto bits = static_cast<mp_bitcnt_t>(std::labs(exponent));
  for (Rational3& p : mesh.vertices) {
    for (Rational& x : p) {
      if (exponent > 0) {
        mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), bits);
      } else {
        mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), bits);
      }
    }
  }
  return mesh;
}

// Times 2^exponent. Where a bound leaves the range of normal doubles, it is the next one that holds.
DistanceBounds scaled(const DistanceBounds& bounds, long exponent) {
  const auto power = static_cast<int>(std::clamp(exponent, -100000L, 100000L));
  DistanceBounds result{std::ldexp(bounds.low, power), std::ldexp(bounds.high, power)};
  if (result.low < std::numeric_limits<double>::min()) result.low = std::nextafter(result.low, -1.0);
  if (result.high < std::numeric_limits<double>::min()) result.high = std::nextafter(result.high, 1.0);
  result.low = std::clamp(result.low, 0.0, std::numeric_limits<double>::max());
  return result;
}

void require_triangles(const Mesh& mesh) {
  if (mesh.face_count() == 0) throw InputError("a mesh without faces has no distance from another");
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face(f).size() != 3) throw InputError("face " + std::to_string(f) + " is not a triangle");
  }
}

}  // namespace

DistanceBounds hausdorff_distance(const Mesh& a, const Mesh& b, std::size_t splits) {
  require_triangles(a);
  require_triangles(b);
  // In this range products of four coordinates, which weights are made of, do not overflow, nor vanish beside the
  // slack, a part of 2^-48 of the largest.
  constexpr long kModerate = 200;
  const long exponent = std::max(exponent_of(a), exponent_of(b));
  if (std::labs(exponent) > kModerate && exponent != std::numeric_limits<long>::min()) {
    return scaled(hausdorff_distance(scaled(a, -exponent), scaled(b, -exponent), splits), exponent);
  }
  const double size = std::max(largest_coordinate(a), largest_coordinate(b));
  const Surface first(a, size);
  const Surface second(b, size);
  Comparison comparison(size);
  comparison.add(first, second, splits / 2);
  comparison.add(second, first, splits / 2);
  return comparison.bounds();
}

}  // namespace nef

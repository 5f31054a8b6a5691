// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/convolution_facets.h"

#include <algorithm>

#include "apps/minkowski/cells/exact_cells.h"
#include "nef/base/interruption.h"
#include "nef/construct/planar_hull.h"
#include "nef/mesh/edge_order.h"

namespace nef::minkowski {
namespace {

// A vertex of A and one of B.
struct Pair {
  std::uint32_t a = 0, b = 0;
};

class Convolution {
 public:
  Convolution(const SolidFeatures& a, const SolidFeatures& b) : a_(a), b_(b) {}

  ConvolutionFacets run() {
    touch_facets(a_, b_, false);
    touch_facets(b_, a_, true);
    for (const SolidFacet& f : a_.facets()) {
      for (const SolidFacet& g : b_.facets()) {
        if (same_direction(f.normal, g.normal)) add_parallel_facets(f, g);
      }
    }
    cross_edges();
    return std::move(result_);
  }

 private:
  // Facets of one solid with edges and vertices of the other one.
  void touch_facets(const SolidFeatures& ours, const SolidFeatures& theirs, bool swapped) {
    const auto pair = [swapped](std::uint32_t own, std::uint32_t other) {
      return swapped ? Pair{other, own} : Pair{own, other};
    };
    for (const SolidFacet& facet : ours.facets()) {
      check_interruption();
      for (std::uint32_t v = 0; v < theirs.points().size(); ++v) {
        if (!theirs.is_peak(v, facet.normal)) continue;
        for (const std::vector<std::uint32_t>& piece : facet.pieces) {
          ring_.clear();
          for (const std::uint32_t u : piece) ring_.push_back(pair(u, v));
          push(facet.normal);
        }
      }
      for (const ConvexEdge& edge : theirs.edges()) {
        if (sign_of_dot(edge.line, facet.normal) != 0 || !edge.touches(facet.normal)) continue;
        for (const std::vector<std::uint32_t>& piece : facet.pieces) {
          ring_.clear();
          for (const std::uint32_t u : piece) ring_.insert(ring_.end(), {pair(u, edge.from), pair(u, edge.to)});
          push_hull(facet.normal);
        }
      }
    }
  }

  void add_parallel_facets(const SolidFacet& f, const SolidFacet& g) {
    for (const std::vector<std::uint32_t>& p : f.pieces) {
      for (const std::vector<std::uint32_t>& q : g.pieces) {
        ring_.clear();
        for (const std::uint32_t a : p) {
          for (const std::uint32_t b : q) ring_.push_back({a, b});
        }
        push_hull(f.normal);
      }
    }
  }

  // Each arc of normals lies on the great circle of its edge. Arcs cross iff the ends of each lie on both sides of the
  // other's circle, and cross where the circles do on the same side of the sphere. Walking along arc A, which runs
  // counterclockwise about edge a, one comes to the side `to` of b's circle at y with sign(y . (b x a)) = to.
  void cross_edges() {
    for (const ConvexEdge& a : a_.edges()) {
      check_interruption();
      for (const ConvexEdge& b : b_.edges()) {
        const int of_a = sign_of_dot(b.line, a.last);
        if (of_a == 0 || sign_of_dot(b.line, a.first) != -of_a) continue;
        const int of_b = sign_of_dot(a.line, b.last);
        if (of_b != -of_a || sign_of_dot(a.line, b.first) != of_a) continue;
        Direction normal = Direction::cross(b.line, a.line);
        if (of_a < 0) normal = normal.negated();
        ring_ = {{a.from, b.from}, {a.to, b.from}, {a.to, b.to}, {a.from, b.to}};
        // About b x a the edges a, b turn clockwise.
        if (of_a > 0) std::reverse(ring_.begin(), ring_.end());
        push(normal);
      }
    }
  }

  [[nodiscard]] Rational3 sum(const Pair& p) const {
    const Rational3& a = a_.points()[p.a];
    const Rational3& b = b_.points()[p.b];
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  }

  std::uint32_t corner(const Pair& p) {
    const auto [at, is_new] = number_.emplace(pair_key(p.a, p.b), static_cast<std::uint32_t>(result_.points.size()));
    if (is_new) {
      const Rational3 point = sum(p);
      result_.points.push(point);
      result_.rounded.push_back({nearest_double(point[0]), nearest_double(point[1]), nearest_double(point[2])});
    }
    return at->second;
  }

  // The polygon ring_.
  void push(const Direction& normal) {
    for (const Pair& p : ring_) result_.corners.push_back(corner(p));
    const PointId first{result_.corners[result_.begin.back()]};
    result_.plane.push_back(plane_through(result_.planes, result_.points, normal.integers(), first));
    result_.begin.push_back(static_cast<std::uint32_t>(result_.corners.size()));
  }

  // The convex hull of ring_.
  void push_hull(const Direction& normal) {
    std::vector<Rational3> points;
    for (const Pair& p : ring_) points.push_back(sum(p));
    const std::array<Integer, 3>& n = normal.integers();
    std::vector<Pair> hull;
    for (const std::uint32_t i : detail::planar_hull(points, {Rational(n[0]), Rational(n[1]), Rational(n[2])})) {
      hull.push_back(ring_[i]);
    }
    ring_ = std::move(hull);
    push(normal);
  }

  const SolidFeatures& a_;
  const SolidFeatures& b_;
  ConvolutionFacets result_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_;
  std::vector<Pair> ring_;
};

}  // namespace

ConvolutionFacets reduced_convolution(const SolidFeatures& a, const SolidFeatures& b) {
  return Convolution(a, b).run();
}

}  // namespace nef::minkowski

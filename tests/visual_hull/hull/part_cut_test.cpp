// SPDX-License-Identifier: Apache-2.0
//
// What a half-space leaves of a box has few vertices: a plane misses it if they all lie on one side.
#include "apps/visual_hull/viewing_edges/part_cut.h"

#include <catch2/catch.hpp>
#include <random>

#include "tests/support/numbers/next_to_zero.h"

namespace nef::visual_hull {
namespace {

constexpr EdgeView::Window kWindow{{10, 20}, {1, 1}};

// An edge that runs right across the window.
struct EdgeAcross {
  Point2 from{0, 20};
  Point2 to{20, 20};
  ViewingEdge edge;
  EdgeAcross() {
    edge.from = &from;
    edge.to = &to;
  }
  EdgeAcross(const EdgeAcross&) = delete;  // the edge points into it
  EdgeAcross& operator=(const EdgeAcross&) = delete;
};

PartFacet facet_of(const Double3& normal, double offset) {
  PartFacet facet;
  facet.normal = normal;
  facet.offset = offset;
  return facet;
}

bool passes(const PartFacet& plane, const PartBox& box) {
  double reach = 0;
  for (std::size_t k = 0; k < 3; ++k) reach += std::abs(plane.normal[k]) * box.half[k];
  return std::abs(plane.height(box.middle)) < reach;
}

// The corners of the box on the positive side of a plane, and where the plane meets the box's edges.
std::vector<Double3> vertices_left(const PartBox& box, const PartFacet& plane) {
  std::vector<Double3> left;
  const auto corner = [&box](unsigned bits) {
    Double3 p = box.middle;
    for (std::size_t k = 0; k < 3; ++k) p[k] += (bits >> k & 1U) != 0 ? box.half[k] : -box.half[k];
    return p;
  };
  for (unsigned bits = 0; bits < 8; ++bits) {
    const Double3 p = corner(bits);
    const double here = plane.height(p);
    if (here >= 0) left.push_back(p);
    for (std::size_t k = 0; k < 3; ++k) {
      if ((bits >> k & 1U) != 0) continue;
      Double3 q = corner(bits | 1U << k);
      const double there = plane.height(q);
      if ((here > 0) == (there > 0)) continue;
      q[k] = p[k] + here / (here - there) * (q[k] - p[k]);
      left.push_back(q);
    }
  }
  return left;
}

}  // namespace

TEST_CASE("A facet that misses what a cut leaves of a part") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const EdgeAcross edge;
  std::size_t missed = 0;
  std::size_t met = 0;
  for (int round = 0; round < 20000; ++round) {
    const auto vector = [&](double size) {
      return Double3{size * uniform(random), size * uniform(random), size * uniform(random)};
    };
    PartBox box{vector(5), {}};
    for (double& h : box.half) h = 0.5 + 0.4 * uniform(random);
    const auto through = [&](const Double3& normal) {  // a plane through a point near the box
      const Double3 off = vector(0.5);
      PartFacet plane = facet_of(normal, 0);
      plane.offset = -plane.height({box.middle[0] + off[0], box.middle[1] + off[1], box.middle[2] + off[2]});
      return plane;
    };
    const Double3 normal = vector(1);
    const PartFacet plane = through(normal);
    const std::optional<PartCut> cut = PartCut::make(3, plane, edge.edge, box, kWindow);
    if (!cut) continue;
    CHECK(plane.height(cut->point()) > 0);
    // Nearly parallel, as neighbours on a surface are.
    const Double3 turn = vector(0.3);
    const PartFacet other = through({normal[0] + turn[0], normal[1] + turn[1], normal[2] + turn[2]});
    if (!passes(other, box)) continue;  // halving does not ask then
    double lowest = INFINITY;
    double highest = -INFINITY;
    for (const Double3& p : vertices_left(box, plane)) {
      lowest = std::min(lowest, other.height(p));
      highest = std::max(highest, other.height(p));
    }
    if (std::min(std::abs(lowest), std::abs(highest)) < 1e-9) continue;
    const bool misses = lowest > 0 || highest < 0;
    CHECK(cut->misses(other) == misses);
    ++(misses ? missed : met);
  }
  CHECK(missed > 3000);
  CHECK(met > 3000);
}

// The other plane passes through a point of the cut's plane on an edge of the part, and what is left of the part is
// beyond it but for that point; then it is moved by next to nothing.
TEST_CASE("A facet that touches what a cut leaves of a part, or nearly does", "[bounds]") {
  nef::test::NextToZero random(37);
  const EdgeAcross edge;
  std::size_t missed = 0;
  std::size_t met = 0;
  for (int round = 0; round < 20000; ++round) {
    const unsigned bits = 6 + static_cast<unsigned>(random.below(46));
    const double unit = std::ldexp(1.0, static_cast<int>(bits));
    PartBox box;
    Rational3 p;
    Rational3 slope;  // is not below 0 in the part, and 0 at p
    const std::size_t free = random.below(3);
    for (std::size_t k = 0; k < 3; ++k) {
      box.middle[k] = nef::nearest_double(random.number(bits));
      box.half[k] = unit * nef::nearest_double(random.share());
      const int end = random.below(2) == 0 ? 1 : -1;
      const Rational reach = nef::exact_rational(box.half[k]) * end;
      p[k] = nef::exact_rational(box.middle[k]) + (k == free ? reach * random.share() : reach);
      if (k != free) slope[k] = -end * random.share();
    }
    // A plane n . (x - p) + shift in doubles, and what that is off by.
    const auto facet_through_p = [&](const Rational3& n, const Rational& shift) {
      const Rational exact = shift - n[0] * p[0] - n[1] * p[1] - n[2] * p[2];
      PartFacet facet;
      facet.offset = nef::nearest_double(exact);
      double size = std::abs(facet.offset);
      for (std::size_t k = 0; k < 3; ++k) {
        facet.normal[k] = nef::nearest_double(n[k]);
        size += std::abs(facet.normal[k]) * (std::abs(box.middle[k]) + box.half[k]);
      }
      facet.error = size * 0x1p-48;  // part_cut.cpp derives that this is enough
      return facet;
    };
    const Rational3 normal = random.point(8);
    const Rational factor = random.share() * 3;
    const Rational shift = (random.below(4) == 0 ? Rational(1, 16) : random.tiny()) * nef::exact_rational(unit);
    const std::optional<PartCut> cut = PartCut::make(3, facet_through_p(normal, 0), edge.edge, box, kWindow);
    if (!cut) continue;
    Rational3 other = slope;
    for (std::size_t k = 0; k < 3; ++k) other[k] += factor * normal[k];
    const bool misses = cut->misses(facet_through_p(other, shift));
    if (shift <= 0) CHECK_FALSE(misses);
    ++(misses ? missed : met);
  }
  CHECK(missed > 1000);
  CHECK(met > 1000);
}

TEST_CASE("An edge that ends in the window, or a plane that may pass beside the part, is no cut") {
  const PartBox box{{0, 0, 0}, {1, 1, 1}};
  const Point2 before(8, 20);
  const Point2 inside(10.5, 20);
  const Point2 behind(12, 20);
  ViewingEdge edge;
  edge.from = &before;
  edge.to = &behind;
  const auto cut = [&](const PartFacet& facet) { return PartCut::make(0, facet, edge, box, kWindow).has_value(); };
  CHECK(cut(facet_of({1, 0, 0}, 0)));
  CHECK(cut(facet_of({1, 0, 0}, 0.9)));
  CHECK_FALSE(cut(facet_of({1, 0, 0}, 1)));
  CHECK_FALSE(cut(facet_of({1, 0, 0}, -1.5)));
  edge.to = &inside;
  CHECK_FALSE(cut(facet_of({1, 0, 0}, 0)));
}

}  // namespace nef::visual_hull

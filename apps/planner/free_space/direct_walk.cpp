// SPDX-License-Identifier: Apache-2.0
//
// The cell changes only where the segment crosses the plane of a facet near it or, within such a plane, the line of one
// of the facet's edges or one of its isolated vertices; likewise for edges and vertices on no facet. So between all of
// these parameters one point tells for all. Some too many do no harm.
#include "apps/planner/free_space/direct_walk.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace nef::planner {
namespace {

class Crossings {
 public:
  Crossings(const FreeSpace& free, const Rational3& a, const Rational3& b)
      : complex_(free.complex()),
        items_(free.items()),
        a_(a),
        b_(b),
        pa_(a),
        pb_(b),
        from_(to_vector(a)),
        to_(to_vector(b)) {}

  /// All parameters in [0, 1] where the cell may change, in order.
  std::vector<Rational> find() {
    items_.for_each_along(from_, to_, [&](const ItemTree::Item& item, const Box& box) {
      switch (item.kind) {
        case ItemTree::Kind::kFacet:
          facet(complex_.facets[FacetId{item.index}], box);
          break;
        case ItemTree::Kind::kEdge:
          edge(item.index);
          break;
        default:
          vertex(item.index);
      }
    });
    std::sort(result_.begin(), result_.end());
    result_.erase(std::unique(result_.begin(), result_.end()), result_.end());
    return std::move(result_);
  }

 private:
  // Where the segment crosses a plane; false if it runs in it.
  bool plane(PlaneId id, const Box* box) {
    const int at_a = pa_.side(complex_.planes, id);
    const int at_b = pb_.side(complex_.planes, id);
    if (at_a == 0 && at_b == 0) return false;
    if (at_a * at_b > 0 || (box != nullptr && misses(id, *box))) return true;
    const Rational fa(pa_.exact_form(complex_.planes, id), pa_.homogeneous()[3]);
    const Rational fb(pb_.exact_form(complex_.planes, id), pb_.homogeneous()[3]);
    add(fa, fb);
    return true;
  }

  void add(Rational fa, Rational fb) {
    fa.canonicalize();
    fb.canonicalize();
    result_.push_back(fa / (fa - fb));
  }

  // True if the crossing with the plane is certainly not in the box. The parameter is off by the errors of the forms
  // over their difference, and some u.
  [[nodiscard]] bool misses(PlaneId id, const Box& box) const {
    const Approximation fa = pa_.form(complex_.planes, id);
    const Approximation fb = pb_.form(complex_.planes, id);
    const double span = std::fabs(fa.value - fb.value);
    const double error = 2 * (fa.error + fb.error);
    if (!(span > 4 * error)) return false;
    const double t = fa.value / (fa.value - fb.value);
    const double t_error = 2 * error / span + 0x1p-48;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double along = to_[i] - from_[i];
      const double x = from_[i] + t * along;
      const double margin = std::fabs(along) * t_error + (std::fabs(from_[i]) + std::fabs(to_[i])) * 0x1p-48 + 1e-300;
      if (x + margin < box.low[k] || x - margin > box.high[k]) return true;
    }
    return false;
  }

  void facet(const Facet& facet, const Box& box) {
    if (plane(facet.plane, &box)) return;
    for (const std::uint32_t corner : complex_.corners_of(facet)) edge(complex_.corner_halfedge(corner));
    for (const std::uint32_t v : complex_.isolated_vertices_of(facet)) vertex(v);
  }

  void edge(std::uint32_t halfedge) {
    const SVertex& s = complex_.svertices[halfedge];
    const bool crosses_p = plane(s.p, nullptr);
    const bool crosses_q = plane(s.q, nullptr);
    if (crosses_p || crosses_q) return;
    vertex(complex_.svertex_owner[halfedge]);
    vertex(complex_.target(halfedge));
  }

  // The parameter of a point that may lie on the segment.
  void vertex(std::uint32_t v) {
    const Rational3 x = complex_.points.rational(PointId{v});
    for (std::size_t i = 0; i < 3; ++i) {
      if (a_[i] == b_[i]) continue;
      const Rational t = (x[i] - a_[i]) / (b_[i] - a_[i]);
      if (t >= 0 && t <= 1) result_.push_back(t);
      return;
    }
  }

  const Complex& complex_;
  const ItemTree& items_;
  const Rational3& a_;
  const Rational3& b_;
  ExactPoint pa_;
  ExactPoint pb_;
  Vector3d from_;
  Vector3d to_;
  std::vector<Rational> result_;
};

}  // namespace

void walk_directly(const FreeSpace& free, const Rational3& a, const Rational3& b,
                   const std::function<bool(const DirectPart&)>& visit) {
  const std::vector<Rational> crossings = Crossings(free, a, b).find();
  const auto cell_at = [&](const Rational& t) {
    return free.locate(
        ExactPoint(Rational3{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])}));
  };
  const Rational zero(0);
  const Rational one(1);
  CellId cell = free.locate(ExactPoint(a));
  if (!visit({cell, true, zero, zero})) return;
  bool open = crossings.empty() || crossings.front() != 0;  // the cell of the point before goes on
  const Rational* before = &zero;
  const auto interval = [&](const Rational& end) {
    if (!open) cell = cell_at((*before + end) / 2);
    return visit({cell, false, *before, end});
  };
  for (const Rational& t : crossings) {
    if (t == 0) continue;
    if (!interval(t)) return;
    cell = cell_at(t);
    if (!visit({cell, true, t, t})) return;
    open = false;
    before = &t;
  }
  if (*before == 1 || !interval(one)) return;
  visit({cell, true, one, one});
}

}  // namespace nef::planner

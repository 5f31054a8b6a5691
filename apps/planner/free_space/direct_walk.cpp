// SPDX-License-Identifier: Apache-2.0
//
// The cell changes only where the segment crosses the plane of a facet near it or, within such a plane, the line of one
// of the facet's edges or one of its isolated vertices; likewise for edges and vertices on no facet. So between all of
// these parameters one point tells for all. Some too many do no harm; a crossing that is surely beside the facet is
// left out, and where one is surely inside, the facet itself tells what is there, before and after.
#include "apps/planner/free_space/direct_walk.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "apps/planner/intersection/facet_meeting.h"

namespace nef::planner {
namespace {

// A parameter where the cell may change, and the cells there, shortly before and after, where they are known.
struct Crossing {
  Rational t;
  CellId on = kNoCell;
  CellId before = kNoCell;
  CellId after = kNoCell;
};

class Crossings {
 public:
  using Allowed = std::function<bool(CellId)>;

  Crossings(const FreeSpace& free, const Rational3& a, const Rational3& b)
      : free_(free),
        complex_(free.complex()),
        a_(a),
        b_(b),
        pa_(a),
        pb_(b),
        from_(to_vector(pa_.approximate())),
        to_(to_vector(pb_.approximate())) {}

  /// Finds all parameters in [0, 1] where the cell may change. With `allowed`, false as soon as some cell on the
  /// segment surely is not.
  bool find(const Allowed* allowed = nullptr) {
    allowed_ = allowed;
    free_.items().for_each_along(from_, to_, [&](const ItemRef& item) {
      switch (item.kind) {
        case ItemRef::Kind::kFacet:
          facet(item.facet());
          break;
        case ItemRef::Kind::kEdge:
          edge(item.halfedge());
          break;
        default:
          vertex(item.vertex());
      }
      return !blocked_;
    });
    return !blocked_;
  }

  /// In order, each parameter once.
  std::vector<Crossing> take() {
    const auto known = [](const Crossing& c) { return c.on != kNoCell; };
    std::sort(result_.begin(), result_.end(), [&](const Crossing& x, const Crossing& y) {
      const int order = cmp(x.t, y.t);
      return order != 0 ? order < 0 : known(x) > known(y);
    });
    const auto same = [](const Crossing& x, const Crossing& y) { return x.t == y.t; };
    result_.erase(std::unique(result_.begin(), result_.end(), same), result_.end());
    return std::move(result_);
  }

 private:
  void facet(FacetId f) {
    const Facet& facet = complex_.facets[f];
    const Approximation form_a = pa_.form(complex_.planes, facet.plane);
    const Approximation form_b = pb_.form(complex_.planes, facet.plane);
    if (form_a.sign().value_or(0) * form_b.sign().value_or(0) > 0) return;
    const InFacet where = in_facet(complex_, facet, crossing_point(from_, to_, form_a, form_b));
    if (where == InFacet::kOutside) return;
    const int at_a = pa_.side(complex_.planes, facet.plane);
    const int at_b = pb_.side(complex_.planes, facet.plane);
    if (at_a * at_b > 0) return;
    if (at_a == 0 && at_b == 0) {
      for (const SHalfedgeId corner : complex_.corners_of(facet)) edge(complex_.corner_halfedge(corner));
      for (const VertexId v : complex_.isolated_vertices_of(facet)) vertex(v);
      return;
    }
    Crossing crossing;
    if (where == InFacet::kInside && at_a * at_b < 0 && facet.isolated_count == 0) {
      crossing.on = free_.cells().facet(f);
      crossing.before = free_.cells().volume(at_a > 0 ? facet.volume_above : facet.volume_below);
      crossing.after = free_.cells().volume(at_a > 0 ? facet.volume_below : facet.volume_above);
      const auto forbidden = [this](CellId cell) { return allowed_ != nullptr && !(*allowed_)(cell); };
      blocked_ = forbidden(crossing.on) || forbidden(crossing.before) || forbidden(crossing.after);
      if (blocked_) return;
    }
    crossing.t = parameter(facet.plane);
    result_.push_back(std::move(crossing));
  }

  // Where the segment crosses a plane that does not hold it.
  [[nodiscard]] Rational parameter(PlaneId plane) const {
    const Integer at_a = pa_.exact_form(complex_.planes, plane) * pb_.homogeneous()[3];
    const Integer at_b = pb_.exact_form(complex_.planes, plane) * pa_.homogeneous()[3];
    Rational t(at_a, at_a - at_b);
    t.canonicalize();
    return t;
  }

  // Adds where the segment crosses a plane; false if it runs in it.
  bool plane(PlaneId id) {
    const int at_a = pa_.side(complex_.planes, id);
    const int at_b = pb_.side(complex_.planes, id);
    if (at_a == 0 && at_b == 0) return false;
    if (at_a * at_b <= 0) result_.push_back({parameter(id)});
    return true;
  }

  void edge(HalfedgeId halfedge) {
    const SVertex& s = complex_.svertex(halfedge);
    const bool crosses_p = plane(s.p);
    const bool crosses_q = plane(s.q);
    if (crosses_p || crosses_q) return;
    vertex(complex_.source(halfedge));
    vertex(complex_.target(halfedge));
  }

  // The parameter of a point that may lie on the segment.
  void vertex(VertexId v) {
    const Rational3 x = complex_.points.rational(point_of(v));
    for (std::size_t i = 0; i < 3; ++i) {
      if (a_[i] == b_[i]) continue;
      const Rational t = (x[i] - a_[i]) / (b_[i] - a_[i]);
      if (t >= 0 && t <= 1) result_.push_back({t});
      return;
    }
  }

  const FreeSpace& free_;
  const Complex& complex_;
  const Rational3& a_;
  const Rational3& b_;
  ExactPoint pa_;
  ExactPoint pb_;
  Vector3d from_;
  Vector3d to_;
  const Allowed* allowed_ = nullptr;
  bool blocked_ = false;
  std::vector<Crossing> result_;
};

// Visits the parts between and at the crossings.
void walk(const FreeSpace& free, const Rational3& a, const Rational3& b, const std::vector<Crossing>& crossings,
          const std::function<bool(const DirectPart&)>& visit) {
  const auto cell_at = [&](const Rational& t) { return free.locate(ExactPoint(point_between(a, b, t))); };
  const Rational zero(0);
  const Rational one(1);
  const Crossing start{zero};
  const Crossing* before = &start;
  // Up to the first parameter above 0 where the cell may change, it is that of point a, unless it may change there.
  const bool may_change_at_a = !crossings.empty() && crossings.front().t == 0;
  CellId here = crossings.empty() || may_change_at_a ? kNoCell : crossings.front().before;
  if (here == kNoCell) here = free.locate(ExactPoint(a));
  if (!visit({here, true, zero, zero})) return;
  const auto interval = [&](const Rational& end, CellId known) {
    CellId cell = before->after != kNoCell ? before->after : known;
    if (before == &start && !may_change_at_a) cell = here;
    if (cell == kNoCell) cell = cell_at((before->t + end) / 2);
    here = cell;
    return visit({cell, false, before->t, end});
  };
  for (const Crossing& crossing : crossings) {
    if (crossing.t == 0) continue;
    if (!interval(crossing.t, crossing.before)) return;
    here = crossing.on != kNoCell ? crossing.on : cell_at(crossing.t);
    if (!visit({here, true, crossing.t, crossing.t})) return;
    before = &crossing;
  }
  if (before->t == 1 || !interval(one, kNoCell)) return;
  visit({here, true, one, one});
}

}  // namespace

void walk_directly(const FreeSpace& free, const Rational3& a, const Rational3& b,
                   const std::function<bool(const DirectPart&)>& visit) {
  Crossings crossings(free, a, b);
  crossings.find();
  walk(free, a, b, crossings.take(), visit);
}

bool stays_directly(const FreeSpace& free, const Rational3& a, const Rational3& b,
                    const std::function<bool(CellId)>& allowed) {
  Crossings crossings(free, a, b);
  if (!crossings.find(&allowed)) return false;
  bool stays = true;
  walk(free, a, b, crossings.take(), [&](const DirectPart& part) { return stays = allowed(part.cell); });
  return stays;
}

}  // namespace nef::planner

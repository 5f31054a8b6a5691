// SPDX-License-Identifier: Apache-2.0
//
// Both sets divide space into items: vertices, edges, facets and volumes. If A and B have a common point, it lies in
// one item of each, and the closure of the connected part of these two items in common around it holds a vertex of the
// arrangement of both, since the sets are bounded: a vertex of A or B, or a point where an edge of one crosses a facet
// or an edge of the other. So the sets meet iff the local pyramids of both meet at such a point.
//
// Where a vertex of A lies in a volume of B, they meet iff the volume is in B, since each vertex is on the boundary of
// A. For the vertices that edges connect, one has to be asked, and only if no contact was found on the edges: where an
// edge of A leaves a contact into a volume that is in B, the local pyramids meet at the contact.
//
// Edges are asked against facets, in doubles first (`CrossingFilter`). If an edge crosses the inside of a facet, the
// sets meet: near the edge there are points of its set, all of whose translates along the edge are such, and one of
// these is on the facet or on whichever side of it belongs to the other set. Edges and vertices without facets ask each
// other, and are located.
#include "nef/distance/meeting_search.h"

#include <algorithm>
#include <set>

#include "nef/base/fast_path.h"
#include "nef/complex/item_boxes.h"
#include "nef/complex/local_pyramid.h"
#include "nef/distance/nearest_features.h"
#include "nef/geometry/vectors.h"
#include "nef/location/facet_search.h"
#include "nef/sphere_map/overlay.h"

namespace nef {
namespace {

// A point, and the same in doubles.
struct Spot {
  const Rational3& exact;
  const Approximation3& near;
};

template <typename Number>
Number turn(const std::array<Number, 3>& p, const std::array<Number, 3>& q, const std::array<Number, 3>& r,
            std::size_t axis) {
  const std::size_t x = (axis + 1) % 3;
  const std::size_t y = (axis + 2) % 3;
  return (q[x] - p[x]) * (r[y] - p[y]) - (q[y] - p[y]) * (r[x] - p[x]);
}

// The turn of three points of a plane, seen along an axis.
int turn(const Spot& p, const Spot& q, const Spot& r, std::size_t axis, const Monitor& monitor) {
  return sign_by_ladder(turn(p.near, q.near, r.near, axis), monitor,
                        [&] { return sgn(turn(p.exact, q.exact, r.exact, axis)); });
}

// One question.
class MeetingSearch {
 public:
  MeetingSearch(const MeetingSets& body, const Rational3& translation, const Monitor& monitor)
      : body_(body),
        monitor_(monitor),
        both_(body.sides[0]->c.label_count, body.sides[1]->c.label_count,
              [](LabelId x, LabelId y) { return static_cast<LabelId>(x != 0 && y != 0); }) {
    const Rational3 back = {Rational(-translation[0]), Rational(-translation[1]), Rational(-translation[2])};
    shift_ = {back, translation};
    for (std::size_t x = 0; x < 2; ++x) {
      Integer& common = shift_integers_[x][3];
      common = 1;
      for (const Rational& by : shift_[x]) mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), by.get_den_mpz_t());
      for (std::size_t i = 0; i < 3; ++i)
        shift_integers_[x][i] = shift_[x][i].get_num() * (common / shift_[x][i].get_den());
    }
    for (std::size_t x = 0; x < 2; ++x) {
      for (std::size_t i = 0; i < 3; ++i) {
        rounded_shift_[x][i] = nearest_double(shift_[x][i]);
        near_shift_[x][i] = approximation_of(shift_[x][i]);
      }
      touched_[x].assign(side(x).c.vertex_count(), 0);
    }
  }

  bool run() {
    if (!shifted(side(0).bounds, rounded_shift_[0]).overlaps(side(1).bounds)) return false;
    edges_against_facets();
    if (!found_) bare_edges();
    for (std::size_t x = 0; x < 2 && !found_; ++x) locate_parts(x);
    return found_;
  }

  // After a run that found no common point.
  [[nodiscard]] std::vector<std::array<ItemRef, 2>> contacts() const { return {contacts_.begin(), contacts_.end()}; }

 private:
  [[nodiscard]] const MeetingSide& side(std::size_t x) const { return *body_.sides[x]; }

  // A vertex of side x where the other side sees it.
  [[nodiscard]] Rational3 moved(std::size_t x, VertexId v) const { return plus(side(x).points[v.index()], shift_[x]); }

  // Items of both sides at one point.
  void contact(std::size_t x, const ItemRef& own, const ItemRef& other) {
    const std::array<ItemRef, 2> places = x == 0 ? std::array{own, other} : std::array{other, own};
    if (found_ || !contacts_.insert(places).second) return;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t part = side(k).part_of(places[k]);
      if (part != kNone) touched_[k][part] = 1;
    }
    found_ = (mark_of(side(0).c, places[0]) != 0 && mark_of(side(1).c, places[1]) != 0) || pyramids_meet(places);
  }

  bool pyramids_meet(const std::array<ItemRef, 2>& places) {
    for (std::size_t k = 0; k < 2; ++k) {
      pyramid_of(side(k).c, places[k], pyramid_[k]);
      for_each_plane(pyramid_[k], [&](PlaneId& plane) {
        if (!plane.valid()) return;
        const PlaneId unflipped = body_.normals[k][plane.row()];
        plane = plane.flipped() ? unflipped.opposite() : unflipped;
      });
    }
    overlay_.overlay(body_.planes, pyramid_[0].view(), pyramid_[1].view(), both_, out_, monitor_);
    const auto any = [](const auto& items) {
      return std::any_of(items.begin(), items.end(), [](const auto& item) { return item.mark != 0; });
    };
    return out_.mark != 0 || any(out_.sfaces) || any(out_.shalfedges) || any(out_.sloops) || any(out_.svertices);
  }

  // Most sets that meet do so where an edge surely crosses a facet; exact numbers are for pairs that are left if none
  // does.
  void edges_against_facets() {
    std::array<std::vector<std::array<std::uint32_t, 2>>, 2> unsure;
    for (std::size_t x = 0; x < 2 && !found_; ++x) {
      const MeetingSide& own = side(x);
      const MeetingSide& other = side(1 - x);
      monitor_.check_interruption();
      for_each_near_pair(own, rounded_shift_[x], other, [&](std::uint32_t e, std::uint32_t f) {
        const EdgeCrossing crossing =
            kFastPaths ? other.filter->ask(FacetId{f}, near_moved(x, own.edges[e].from), near_moved(x, own.edges[e].to))
                       : EdgeCrossing::kUnsure;
        if (crossing == EdgeCrossing::kUnsure) {
          unsure[x].push_back({e, f});
        } else {
          monitor_.count_filter();
          found_ = crossing == EdgeCrossing::kCrosses;
        }
        return !found_;
      });
    }
    for (std::size_t x = 0; x < 2 && !found_; ++x) {
      std::sort(unsure[x].begin(), unsure[x].end());
      std::uint32_t last = kNone;
      Moving edge;
      for (const auto& [e, f] : unsure[x]) {
        if (e != last) {
          monitor_.check_interruption();
          edge = {};
          last = e;
        }
        meet_facet(x, side(x).edges[e], edge, FacetId{f});
        if (found_) break;
      }
    }
  }

  [[nodiscard]] Approximation3 near_moved(std::size_t x, VertexId v) const {
    return moved_by(side(x).filter->point(v), near_shift_[x]);
  }

  // An edge where the other side sees it, made when it is needed.
  struct Moving {
    bool known = false;
    PointTable table;  // both ends, then points on it; coordinates may have common factors
    std::optional<std::array<Rational3, 2>> ends;

    const std::array<Rational3, 2>& exact_ends() {
      if (!ends) ends = {table.rational(PointId{0U}), table.rational(PointId{1U})};
      return *ends;
    }
  };

  // Appends a vertex of side x where the other side sees it.
  void push_moved(std::size_t x, VertexId v, PointTable& to) const {
    const std::array<IntegerView, 4> point = side(x).c.points.coordinates(point_of(v));
    std::array<Integer, 7> h;
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_mul(h[i].get_mpz_t(), point[i], shift_integers_[x][3].get_mpz_t());
      mpz_addmul(h[i].get_mpz_t(), point[3], shift_integers_[x][i].get_mpz_t());
    }
    mpz_mul(h[3].get_mpz_t(), point[3], shift_integers_[x][3].get_mpz_t());
    to.push_homogeneous(h);
  }

  void meet_facet(std::size_t x, const EdgeEnds& edge, Moving& at, FacetId f) {
    const Complex& c = side(1 - x).c;
    if (!at.known) {
      for (const VertexId v : {edge.from, edge.to}) push_moved(x, v, at.table);
      at.known = true;
    }
    const Facet& facet = c.facets[f];
    std::array<int, 2> sign{};
    for (std::uint32_t k = 0; k < 2; ++k) {
      sign[k] = side_of_plane(c.planes, facet.plane, PointRef{&at.table, PointId{k}}, monitor_);
    }
    if (sign[0] * sign[1] > 0) return;
    if (sign[0] * sign[1] < 0) {
      const PointId crossing = push_crossing(c.planes, facet.plane, at.table);
      meet_at(x, ItemRef(edge.halfedge), f, {&at.table, crossing});
      at.table.pop();
      return;
    }
    if (sign[0] == 0) meet_at(x, ItemRef(edge.from), f, {&at.table, PointId{0U}});
    if (sign[1] == 0) meet_at(x, ItemRef(edge.to), f, {&at.table, PointId{1U}});
    if (sign[0] == 0 && sign[1] == 0) meet_border(x, edge, at.exact_ends(), f);
  }

  // Appends the point where the segment between the first two points crosses a plane: with the plane's forms v0 and v1
  // at their coordinates x0 and x1, that is v0 x1 - v1 x0.
  static PointId push_crossing(const PlaneTable& planes, PlaneId plane, PointTable& table) {
    std::array<Integer, 2> form;
    for (std::uint32_t k = 0; k < 2; ++k) {
      const std::array<IntegerView, 4> x = table.coordinates(PointId{k});
      for (std::size_t i = 0; i < 4; ++i) mpz_addmul(form[k].get_mpz_t(), planes.coefficient(plane, i), x[i]);
    }
    std::array<Integer, 7> h;
    for (std::size_t i = 0; i < 4; ++i) {
      mpz_mul(h[i].get_mpz_t(), form[0].get_mpz_t(), table.coordinate(PointId{1U}, i));
      mpz_submul(h[i].get_mpz_t(), form[1].get_mpz_t(), table.coordinate(PointId{0U}, i));
    }
    return table.push_homogeneous(h);
  }

  // A point of side x that is on the plane of a facet.
  void meet_at(std::size_t x, const ItemRef& own, FacetId f, const PointRef& point) {
    const MeetingSide& other = side(1 - x);
    const ItemRef place = locate_in_facet(other.c, f, point, other.tree_of(f), monitor_);
    if (place.kind == ItemRef::Kind::kFacet) contact(x, own, inside_of(other.c, f, point));
    if (place.kind == ItemRef::Kind::kEdge) contact(x, own, edge_of(other.c, place.halfedge()));
    if (place.kind == ItemRef::Kind::kVertex) contact(x, own, place);
  }

  // The facet itself, or the vertex in its inside at this point: one that is no corner of it.
  [[nodiscard]] ItemRef inside_of(const Complex& c, FacetId f, const PointRef& point) const {
    for (const VertexId v : c.isolated_vertices_of(c.facets[f])) {
      if (same_point({&c.points, point_of(v)}, point, monitor_)) return ItemRef(v);
    }
    return ItemRef(f);
  }

  static ItemRef edge_of(const Complex& c, HalfedgeId h) { return ItemRef(std::min(h, c.twin[h])); }

  static bool is_one_of(const Rational3& point, const std::array<Rational3, 2>& ends) {
    return point == ends[0] || point == ends[1];
  }

  // An edge of side x in the plane of a facet, and the facet's border: crossings, and vertices inside of the edge.
  void meet_border(std::size_t x, const EdgeEnds& edge, const std::array<Rational3, 2>& end, FacetId f) {
    const MeetingSide& other = side(1 - x);
    const Approximation3 near_from = near_moved(x, edge.from);
    const Approximation3 near_to = near_moved(x, edge.to);
    const Spot from_end{end[0], near_from};
    const Spot to_end{end[1], near_to};
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (abs(Integer(other.c.planes.coefficient(other.c.facets[f].plane, i))) >
          abs(Integer(other.c.planes.coefficient(other.c.facets[f].plane, axis))))
        axis = i;
    }
    for (const SHalfedgeId corner : other.c.corners_of(other.c.facets[f])) {
      const HalfedgeId h = other.c.corner_halfedge(corner);
      const VertexId from = other.c.shalfedge_vertex(corner);
      const VertexId to = other.c.target(h);
      const Spot p{other.points[from.index()], other.filter->point(from)};
      const Spot q{other.points[to.index()], other.filter->point(to)};
      // Parts that fit each other have most corners in common: on the line of the edge, but not inside of it.
      if (is_one_of(p.exact, end)) continue;
      const int of_p = turn(from_end, to_end, p, axis, monitor_);
      if (of_p == 0) {
        const Rational3 to_ends[2] = {minus(end[0], p.exact), minus(end[1], p.exact)};
        if (dot(to_ends[0], to_ends[1]) < 0) contact(x, ItemRef(edge.halfedge), ItemRef(from));
        continue;
      }
      if (is_one_of(q.exact, end) || of_p * turn(from_end, to_end, q, axis, monitor_) >= 0) continue;
      if (turn(p, q, from_end, axis, monitor_) * turn(p, q, to_end, axis, monitor_) < 0)
        contact(x, ItemRef(edge.halfedge), edge_of(other.c, h));
    }
  }

  // Edges without facets against each other, and their ends, which nothing else asks for.
  void bare_edges() {
    for (const EdgeEnds& e : side(0).bare) {
      const std::array<Rational3, 2> ends = {moved(0, e.from), moved(0, e.to)};
      for (const EdgeEnds& f : side(1).bare) {
        const std::array<Rational3, 2> others = {side(1).points[f.from.index()], side(1).points[f.to.index()]};
        const NearestPair pair = nearest_of_segments(ends, others);
        if (pair.squared != 0) continue;
        const auto place = [&](const EdgeEnds& of, const std::array<Rational3, 2>& at) {
          if (pair.on_a == at[0]) return ItemRef(of.from);
          return pair.on_a == at[1] ? ItemRef(of.to) : ItemRef(of.halfedge);
        };
        contact(0, place(e, ends), place(f, others));
      }
    }
    for (std::size_t x = 0; x < 2; ++x) {
      for (const EdgeEnds& e : side(x).bare) {
        for (const VertexId v : {e.from, e.to}) locate_vertex(x, v);
      }
    }
  }

  void locate_vertex(std::size_t x, VertexId v) {
    if (found_ || !shifted(vertex_box(side(x).c, v), rounded_shift_[x]).overlaps(side(1 - x).bounds)) return;
    const Location at = locate(side(1 - x).set, moved(x, v), monitor_);
    if (at.kind == Location::Kind::kVolume) {
      found_ = at.mark != 0;
    } else if (at.kind == Location::Kind::kEdge) {
      contact(x, ItemRef(v), edge_of(side(1 - x).c, at.halfedge()));
    } else {
      contact(x, ItemRef(v), at);
    }
  }

  void locate_parts(std::size_t x) {
    for (const std::uint32_t part : side(x).parts) {
      if (touched_[x][part] == 0 || side(x).c.sphere_map(VertexId{part}).svertices.empty())
        locate_vertex(x, VertexId{part});
    }
  }

  const MeetingSets& body_;
  Monitor monitor_;
  LabelFunction both_;
  std::array<Rational3, 2> shift_;                        // of each side, to where the other one sees it
  std::array<std::array<Integer, 4>, 2> shift_integers_;  // the same with a common denominator
  std::array<std::array<double, 3>, 2> rounded_shift_{};
  std::array<Approximation3, 2> near_shift_;
  std::array<std::vector<std::uint8_t>, 2> touched_;  // parts of boundaries
  std::set<std::array<ItemRef, 2>> contacts_;
  std::array<SphereMapBuffer, 2> pyramid_;
  SphereMapBuffer out_;
  SphereOverlay overlay_;
  bool found_ = false;
};

}  // namespace

bool meet(const MeetingSets& sets, const Rational3& translation, const Monitor& monitor) {
  return MeetingSearch(sets, translation, monitor).run();
}

std::optional<std::vector<std::array<ItemRef, 2>>> contacts(const MeetingSets& sets, const Rational3& translation,
                                                            const Monitor& monitor) {
  MeetingSearch search(sets, translation, monitor);
  if (search.run()) return std::nullopt;
  return search.contacts();
}

}  // namespace nef

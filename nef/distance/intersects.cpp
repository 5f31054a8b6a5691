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
// Edges are asked against facets. Edges and vertices without facets ask each other, and are located.
#include "nef/distance/intersects.h"

#include <array>
#include <cmath>
#include <set>
#include <unordered_map>
#include <vector>

#include "nef/base/union_find.h"
#include "nef/complex/item_boxes.h"
#include "nef/complex/local_pyramid.h"
#include "nef/distance/nearest_features.h"
#include "nef/geometry/box_tree.h"
#include "nef/geometry/vectors.h"
#include "nef/location/facet_search.h"
#include "nef/polyhedron.h"
#include "nef/sphere_map/overlay.h"

namespace nef {
// Not anonymous: IntersectionQuery::Body has members of these types.
namespace meeting {

struct EdgeEnds {
  HalfedgeId halfedge{0};
  VertexId from{0}, to{0};
};

// A vertex, an edge (as a halfedge) or a facet.
struct Place {
  Location::Kind kind = Location::Kind::kVertex;
  std::uint32_t index = 0;
  auto operator<=>(const Place&) const = default;
};

Place at_vertex(VertexId v) { return {Location::Kind::kVertex, v.index()}; }
Place at_edge(HalfedgeId h) { return {Location::Kind::kEdge, h.index()}; }

// The box moved, rounded outward: doubles of boxes and of the translation are within 2^-52 relative, and each bound
// rounds once more.
Box shifted(const Box& box, const std::array<double, 3>& by) {
  Box result;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = box.low[i] + by[i];
    const double high = box.high[i] + by[i];
    const double slack = (std::fabs(box.low[i]) + std::fabs(box.high[i]) + std::fabs(by[i])) * 0x1p-50 + 1e-300;
    const bool known = slack < HUGE_VAL;
    result.low[i] = known ? low - slack : -HUGE_VAL;
    result.high[i] = known ? high + slack : HUGE_VAL;
  }
  return result;
}

// What of one set is the same for all translations.
struct Side {
  explicit Side(const Polyhedron& of) : set(of), c(set.complex()) {
    for (const VertexId v : c.vertex_ids()) points.push_back(c.points.rational(point_of(v)));
    std::vector<Box> boxes;
    UnionFind connected(c.vertex_count());
    for (const HalfedgeId h : c.halfedge_ids()) {
      if (h > c.twin[h]) continue;
      edges.push_back({h, c.source(h), c.target(h)});
      connected.unite(c.source(h).index(), c.target(h).index());
      boxes.push_back(edge_box(c, h));
    }
    edge_tree = BoxTree(boxes);
    edge_boxes = std::move(boxes);
    boxes.clear();
    for (const Facet& facet : c.facets) {
      boxes.push_back(facet_box(c, facet));
      constexpr std::size_t kMany = 64;
      if (c.corners_of(facet).size() >= kMany) trees.emplace(boxes.size() - 1, facet_edge_tree(c, facet));
    }
    facet_tree = BoxTree(boxes);
    bounds = vertices_box(c);
    for (std::uint32_t v = 0; v < c.vertex_count(); ++v) {
      part.push_back(connected.find(v));
      if (part.back() == v) parts.push_back(v);
    }
    for (const HalfedgeId h : c.bare_edges()) bare.push_back({h, c.source(h), c.target(h)});
  }

  [[nodiscard]] const BoxTree* tree_of(FacetId facet) const {
    const auto found = trees.find(facet.index());
    return found == trees.end() ? nullptr : &found->second;
  }

  [[nodiscard]] LabelId mark(const Place& place) const {
    if (place.kind == Location::Kind::kVertex) return c.mark(VertexId{place.index});
    if (place.kind == Location::Kind::kEdge) return c.svertex(HalfedgeId{place.index}).mark;
    return c.facets[FacetId{place.index}].mark;
  }

  void pyramid(const Place& place, SphereMapBuffer& out) const {
    if (place.kind == Location::Kind::kVertex) {
      out.assign(c.sphere_map(VertexId{place.index}));
    } else if (place.kind == Location::Kind::kEdge) {
      const HalfedgeId h{place.index};
      const VertexId v = c.source(h);
      edge_pyramid(c.sphere_map(v), c.halfedges(v).position(h), out);
    } else {
      const Facet& facet = c.facets[FacetId{place.index}];
      out.assign_circle(facet.plane, facet.mark, c.volumes[facet.volume_above].mark,
                        c.volumes[facet.volume_below].mark);
    }
  }

  // A vertex on the part of the boundary, connected by edges, that an item is on; kNone for facets.
  [[nodiscard]] std::uint32_t part_of(const Place& place) const {
    if (place.kind == Location::Kind::kVertex) return part[place.index];
    return place.kind == Location::Kind::kEdge ? part[c.source(HalfedgeId{place.index}).index()] : kNone;
  }

  Polyhedron set;
  const Complex& c;
  std::vector<Rational3> points;
  std::vector<EdgeEnds> edges, bare;  // bare edges bound no facet
  std::vector<Box> edge_boxes;
  BoxTree edge_tree, facet_tree;
  std::unordered_map<std::size_t, BoxTree> trees;  // of facets with many corners
  Box bounds;
  std::vector<std::uint32_t> part;   // per vertex, one of those that edges connect it with
  std::vector<std::uint32_t> parts;  // these
};

// The planes of a complex, moved to the origin, in a common table: equal where normals are.
std::vector<PlaneId> intern_normals(const PlaneTable& from, PlaneTable& to) {
  std::vector<PlaneId> result;
  for (std::uint32_t row = 0; row < from.size(); ++row) {
    const PlaneId plane{row << 1U};
    result.push_back(to.intern(Integer(from.coefficient(plane, 0)), Integer(from.coefficient(plane, 1)),
                               Integer(from.coefficient(plane, 2)), Integer(0)));
  }
  return result;
}

Rational3 sum(const Rational3& p, const Rational3& q) {
  return {Rational(p[0] + q[0]), Rational(p[1] + q[1]), Rational(p[2] + q[2])};
}

// The turn of three points of a plane, seen along an axis.
int turn(const Rational3& p, const Rational3& q, const Rational3& r, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3;
  const std::size_t y = (axis + 2) % 3;
  return sgn(Rational((q[x] - p[x]) * (r[y] - p[y]) - (q[y] - p[y]) * (r[x] - p[x])));
}

}  // namespace meeting

struct IntersectionQuery::Body {
  Body(const Polyhedron& of_a, const Polyhedron& of_b) : sets{of_a, of_b} {
    if (of_a.is_empty() || of_b.is_empty() || !of_a.is_bounded() || !of_b.is_bounded()) return;
    for (const Polyhedron& set : sets) {
      sides.push_back(std::make_unique<meeting::Side>(set));
      normals.push_back(meeting::intern_normals(set.complex().planes, planes));
    }
  }

  std::array<Polyhedron, 2> sets;
  std::vector<std::unique_ptr<const meeting::Side>> sides;  // none if a set is empty or unbounded
  PlaneTable planes;                                        // through the origin
  std::vector<std::vector<PlaneId>> normals;                // of each side's planes
};

namespace meeting {

// One question.
template <typename Body>
class MeetingSearch {
 public:
  MeetingSearch(const Body& body, const Rational3& translation, const Monitor& monitor)
      : body_(body),
        monitor_(monitor),
        both_(body.sides[0]->c.label_count, body.sides[1]->c.label_count,
              [](LabelId x, LabelId y) { return static_cast<LabelId>(x != 0 && y != 0); }) {
    const Rational3 back = {Rational(-translation[0]), Rational(-translation[1]), Rational(-translation[2])};
    shift_ = {back, translation};
    for (std::size_t x = 0; x < 2; ++x) {
      for (std::size_t i = 0; i < 3; ++i) rounded_shift_[x][i] = nearest_double(shift_[x][i]);
      touched_[x].assign(side(x).c.vertex_count(), 0);
    }
  }

  bool run() {
    if (!shifted(side(0).bounds, rounded_shift_[0]).overlaps(side(1).bounds)) return false;
    for (std::size_t x = 0; x < 2 && !found_; ++x) edges_against_facets(x);
    if (!found_) bare_edges();
    for (std::size_t x = 0; x < 2 && !found_; ++x) locate_parts(x);
    return found_;
  }

 private:
  [[nodiscard]] const Side& side(std::size_t x) const { return *body_.sides[x]; }

  // A vertex of side x where the other side sees it.
  [[nodiscard]] Rational3 moved(std::size_t x, VertexId v) const { return sum(side(x).points[v.index()], shift_[x]); }

  // Items of both sides at one point.
  void contact(std::size_t x, const Place& own, const Place& other) {
    const std::array<Place, 2> places = x == 0 ? std::array{own, other} : std::array{other, own};
    if (found_ || !contacts_.insert(places).second) return;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::uint32_t part = side(k).part_of(places[k]);
      if (part != kNone) touched_[k][part] = 1;
    }
    found_ = (side(0).mark(places[0]) != 0 && side(1).mark(places[1]) != 0) || pyramids_meet(places);
  }

  bool pyramids_meet(const std::array<Place, 2>& places) {
    for (std::size_t k = 0; k < 2; ++k) {
      side(k).pyramid(places[k], pyramid_[k]);
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

  void edges_against_facets(std::size_t x) {
    const Side& own = side(x);
    const Side& other = side(1 - x);
    own.edge_tree.for_each_if(
        [&](const Box& box) { return !found_ && shifted(box, rounded_shift_[x]).overlaps(other.bounds); },
        [&](std::uint32_t e) {
          monitor_.check_interruption();
          const Box box = shifted(own.edge_boxes[e], rounded_shift_[x]);
          Moving edge;
          other.facet_tree.for_each_if([&](const Box& of) { return !found_ && of.overlaps(box); },
                                       [&](std::uint32_t f) { meet_facet(x, own.edges[e], edge, FacetId{f}); });
        });
  }

  // An edge where the other side sees it, made when it is needed.
  struct Moving {
    bool known = false;
    std::array<Rational3, 2> end;
    PointTable table;  // both ends, then points on it
  };

  void meet_facet(std::size_t x, const EdgeEnds& edge, Moving& at, FacetId f) {
    const Complex& c = side(1 - x).c;
    if (!at.known) {
      at.end = {moved(x, edge.from), moved(x, edge.to)};
      for (const Rational3& p : at.end) at.table.push(p);
      at.known = true;
    }
    const Facet& facet = c.facets[f];
    std::array<int, 2> sign{};
    for (std::uint32_t k = 0; k < 2; ++k) {
      sign[k] = side_of_plane(c.planes, facet.plane, PointRef{&at.table, PointId{k}}, monitor_);
    }
    if (sign[0] * sign[1] > 0) return;
    if (sign[0] * sign[1] < 0) {
      const PointId crossing = at.table.push(crossing_point(c.planes, facet.plane, at.end));
      meet_at(x, at_edge(edge.halfedge), f, {&at.table, crossing});
      at.table.pop();
      return;
    }
    if (sign[0] == 0) meet_at(x, at_vertex(edge.from), f, {&at.table, PointId{0U}});
    if (sign[1] == 0) meet_at(x, at_vertex(edge.to), f, {&at.table, PointId{1U}});
    if (sign[0] == 0 && sign[1] == 0) meet_border(x, edge, at.end, f);
  }

  static Rational3 crossing_point(const PlaneTable& planes, PlaneId plane, const std::array<Rational3, 2>& end) {
    Rational3 normal;
    for (std::size_t i = 0; i < 3; ++i) normal[i] = Integer(planes.coefficient(plane, i));
    const Rational offset = Integer(planes.coefficient(plane, 3));
    const Rational from = dot(normal, end[0]) + offset;
    const Rational to = dot(normal, end[1]) + offset;
    const Rational t = from / (from - to);
    Rational3 point;
    for (std::size_t i = 0; i < 3; ++i) point[i] = end[0][i] + t * (end[1][i] - end[0][i]);
    return point;
  }

  // A point of side x that is on the plane of a facet.
  void meet_at(std::size_t x, const Place& own, FacetId f, const PointRef& point) {
    const Side& other = side(1 - x);
    const FacetPlace place = locate_in_facet(other.c, other.c.facets[f], point, other.tree_of(f), monitor_);
    switch (place.kind) {
      case FacetPlace::Kind::kOutside:
        return;
      case FacetPlace::Kind::kInside:
        return contact(x, own, inside_of(other.c, f, point));
      case FacetPlace::Kind::kEdge:
        return contact(x, own, edge_of(other.c, place.halfedge()));
      case FacetPlace::Kind::kVertex:
        return contact(x, own, at_vertex(place.vertex()));
    }
  }

  // The facet itself, or the vertex in its inside at this point: one that is no corner of it.
  [[nodiscard]] Place inside_of(const Complex& c, FacetId f, const PointRef& point) const {
    for (const VertexId v : c.isolated_vertices_of(c.facets[f])) {
      if (same_point({&c.points, point_of(v)}, point, monitor_)) return at_vertex(v);
    }
    return {Location::Kind::kFacet, f.index()};
  }

  static Place edge_of(const Complex& c, HalfedgeId h) { return at_edge(std::min(h, c.twin[h])); }

  // An edge of side x in the plane of a facet, and the facet's border: crossings, and vertices inside of the edge.
  void meet_border(std::size_t x, const EdgeEnds& edge, const std::array<Rational3, 2>& end, FacetId f) {
    const Side& other = side(1 - x);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (abs(Integer(other.c.planes.coefficient(other.c.facets[f].plane, i))) >
          abs(Integer(other.c.planes.coefficient(other.c.facets[f].plane, axis))))
        axis = i;
    }
    for (const SHalfedgeId corner : other.c.corners_of(other.c.facets[f])) {
      const HalfedgeId h = other.c.corner_halfedge(corner);
      const VertexId from = other.c.shalfedge_vertex(corner);
      const Rational3& p = other.points[from.index()];
      const Rational3& q = other.points[other.c.target(h).index()];
      const int of_p = turn(end[0], end[1], p, axis);
      if (of_p == 0) {
        const Rational3 to_ends[2] = {minus(end[0], p), minus(end[1], p)};
        if (dot(to_ends[0], to_ends[1]) < 0) contact(x, at_edge(edge.halfedge), at_vertex(from));
        continue;
      }
      if (of_p * turn(end[0], end[1], q, axis) >= 0) continue;
      if (turn(p, q, end[0], axis) * turn(p, q, end[1], axis) < 0)
        contact(x, at_edge(edge.halfedge), edge_of(other.c, h));
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
          if (pair.on_a == at[0]) return at_vertex(of.from);
          return pair.on_a == at[1] ? at_vertex(of.to) : at_edge(of.halfedge);
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
      contact(x, at_vertex(v), edge_of(side(1 - x).c, at.halfedge()));
    } else {
      contact(x, at_vertex(v), {at.kind, at.index});
    }
  }

  void locate_parts(std::size_t x) {
    for (const std::uint32_t part : side(x).parts) {
      if (touched_[x][part] == 0 || side(x).c.sphere_map(VertexId{part}).svertices.empty())
        locate_vertex(x, VertexId{part});
    }
  }

  const Body& body_;
  Monitor monitor_;
  LabelFunction both_;
  std::array<Rational3, 2> shift_;  // of each side, to where the other one sees it
  std::array<std::array<double, 3>, 2> rounded_shift_{};
  std::array<std::vector<std::uint8_t>, 2> touched_;  // parts of boundaries
  std::set<std::array<Place, 2>> contacts_;
  std::array<SphereMapBuffer, 2> pyramid_;
  SphereMapBuffer out_;
  SphereOverlay overlay_;
  bool found_ = false;
};

}  // namespace meeting

IntersectionQuery::IntersectionQuery(const Polyhedron& a, const Polyhedron& b)
    : body_(std::make_shared<const Body>(a, b)) {}

bool IntersectionQuery::meet(const Rational3& translation, const Monitor& monitor) const {
  const auto& [a, b] = body_->sets;
  if (a.is_empty() || b.is_empty()) return false;
  if (body_->sides.empty()) {
    return !intersect(a, transform(b, AffineMap::translate(translation), monitor), 1, monitor).is_empty();
  }
  return meeting::MeetingSearch<Body>(*body_, translation, monitor).run();
}

bool intersects(const Polyhedron& a, const Polyhedron& b, const Rational3& translation, const Monitor& monitor) {
  // One question of sets that are far from each other takes no trees.
  if (a.is_bounded() && b.is_bounded()) {
    std::array<double, 3> by{};
    for (std::size_t i = 0; i < 3; ++i) by[i] = nearest_double(translation[i]);
    if (!meeting::shifted(vertices_box(b.complex()), by).overlaps(vertices_box(a.complex()))) return false;
  }
  return IntersectionQuery(a, b).meet(translation, monitor);
}

}  // namespace nef

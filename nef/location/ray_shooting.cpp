// SPDX-License-Identifier: Apache-2.0
//
// Ray shooting: candidates come from the box tree, roughly from near to far; each is decided
// exactly, and the nearest hit so far cuts off what lies behind it.
#include "nef/base/error.h"
#include "nef/geometry/ray_filter.h"
#include "nef/location/facet_search.h"
#include "nef/location/query_structure.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {
namespace {

// Sign of (p - o) . D if p lies on the line of the ray, else nothing.
std::optional<int> position_on_line(const QueryRay& ray, const PointRef& p) {
  const Integer3& d = ray.direction.integers();
  std::array<Integer3, 2> difference;  // constant part, factor of R
  const IntegerView wo = ray.origin.coordinate(3);
  const IntegerView wp = p.coordinate(3);
  for (std::size_t part = 0; part < 2; ++part) {
    for (std::size_t i = 0; i < 3; ++i) {
      mpz_ptr out = difference[part][i].get_mpz_t();
      mpz_mul(out, p.coordinate(4 * part + i), wo);
      mpz_submul(out, ray.origin.coordinate(4 * part + i), wp);
    }
  }
  for (const Integer3& v : difference) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (v[i] * d[j] != v[j] * d[i]) return std::nullopt;
    }
  }
  const auto dot = [&d](const Integer3& v) -> int {
    const Integer sum = v[0] * d[0] + v[1] * d[1] + v[2] * d[2];
    return sgn(sum);
  };
  const int at_infinity = dot(difference[1]);
  return at_infinity != 0 ? at_infinity : dot(difference[0]);
}

}  // namespace

class RayShooter {
 public:
  RayShooter(const Complex& complex, const QueryStructure& structure, const QueryRay& ray,
             const QueryStructure::Accept& accept, const Monitor& monitor)
      : complex_(complex),
        structure_(structure),
        ray_(ray),
        accept_(accept),
        monitor_(monitor),
        filter_(mirrored(point_box(ray.origin)), ray.direction.negated()),
        finite_origin_(ray.origin.table->finite(ray.origin.id)) {}

  std::optional<ComplexHit> shoot(Rational3* at) {
    structure_.tree_.for_each_if([&](const Box& box) { return filter_.may_meet(box); },
                                 [&](std::uint32_t i) { visit(structure_.items_[i]); });
    if (!hit_) return hit_;
    if (at != nullptr) *at = position_.table->rational(position_.id);
    hit_->sface = entered_through(*hit_);
    return hit_;
  }

 private:
  void visit(std::uint32_t item) {
    const std::uint32_t index = item / 4;
    switch (item % 4) {
      case QueryStructure::kVertexItem:
        visit_vertex(VertexId{index});
        break;
      case QueryStructure::kEdgeItem:
        visit_edge(HalfedgeId{index});
        break;
      default:
        visit_facet(FacetId{index});
    }
  }

  void visit_vertex(VertexId vertex) {
    const PointRef point{&complex_.points, point_of(vertex)};
    const std::optional<int> position = position_on_line(ray_, point);
    if (position && *position > 0) offer(ComplexHit(ItemRef(vertex)), point);
  }

  void visit_edge(HalfedgeId halfedge) {
    const SVertex& edge = complex_.svertex(halfedge);
    PlaneId crossed = edge.p;
    PlaneId other = edge.q;
    if (side_of_circle(complex_.planes, crossed, ray_.direction, monitor_) == 0) std::swap(crossed, other);
    const VertexId u = complex_.source(halfedge);
    const VertexId v = complex_.target(halfedge);
    if (side_of_circle(complex_.planes, crossed, ray_.direction, monitor_) == 0) {
      // Parallel: met at its ends, if at all.
      visit_vertex(u);
      visit_vertex(v);
      return;
    }
    const std::optional<PointRef> meeting = meet(crossed);
    if (!meeting || side_of_plane(complex_.planes, other, *meeting, monitor_) != 0) return;
    for (int axis = 0; axis < 3; ++axis) {
      const int u_side = compare_coordinate(PointRef{&complex_.points, point_of(u)}, *meeting, axis, monitor_);
      const int v_side = compare_coordinate(PointRef{&complex_.points, point_of(v)}, *meeting, axis, monitor_);
      if (u_side == 0 && v_side == 0) continue;
      if (u_side * v_side > 0) return;
      if (u_side * v_side < 0) return offer(ComplexHit(ItemRef(halfedge)), *meeting);
      return offer(ComplexHit(ItemRef(u_side == 0 ? u : v)), *meeting);
    }
  }

  void visit_facet(FacetId f) {
    const Facet& facet = complex_.facets[f];
    if (side_of_circle(complex_.planes, facet.plane, ray_.direction, monitor_) == 0) {
      if (side_of_plane(complex_.planes, facet.plane, ray_.origin, monitor_) == 0) visit_boundary(f);
      return;
    }
    const std::optional<PointRef> meeting = meet(facet.plane);
    if (!meeting || (hit_ && !nearer(*meeting))) return;
    const ItemRef place = locate_in_facet(complex_, f, *meeting, structure_.edge_tree(complex_, f), monitor_);
    if (!place.valid()) return;
    if (place.kind != ItemRef::Kind::kFacet) return offer(ComplexHit(place), *meeting);
    if (facet.isolated_count > 0) {
      // What is met may be a vertex inside the facet.
      if (const auto vertex = structure_.free_vertex_at(complex_, *meeting, monitor_)) {
        return offer(ComplexHit(ItemRef(*vertex)), *meeting);
      }
    }
    const bool from_above = side_of_plane(complex_.planes, facet.plane, ray_.origin, monitor_) > 0;
    offer(ComplexHit(halffacet_of(f, !from_above)), *meeting);
  }

  // The ray runs in the plane of the facet.
  void visit_boundary(FacetId f) {
    const std::span<const SHalfedgeId> corners = complex_.corners_of(f);
    const BoxTree* edges = structure_.edge_tree(complex_, f);
    if (edges == nullptr) {
      for (const SHalfedgeId corner : corners) visit_edge(complex_.corner_halfedge(corner));
    } else {
      edges->for_each_if([&](const Box& box) { return filter_.may_meet(mirrored(box)); },
                         [&](std::uint32_t i) { visit_edge(complex_.corner_halfedge(corners[i])); });
    }
  }

  // The point ahead on the ray where it crosses a plane that is not parallel to it.
  // With m = n . D and s = the plane's form at the origin P / w: Q = (m P - s D) / (m w).
  std::optional<PointRef> meet(PlaneId plane) {
    const int side = side_of_plane(complex_.planes, plane, ray_.origin, monitor_);
    const Direction normal = Direction::normal(complex_.planes, plane);
    if (side * sign_of_dot(normal, ray_.direction, monitor_) >= 0) return std::nullopt;
    mpz_ptr m = slope_.get_mpz_t();
    mpz_ptr s = height_.get_mpz_t();
    const Integer3& d = ray_.direction.integers();
    const IntegerView w = ray_.origin.coordinate(3);
    mpz_set_ui(m, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      if (sgn(d[i]) != 0) mpz_addmul(m, complex_.planes.coefficient(plane, i), d[i].get_mpz_t());
    }
    const bool finite = finite_origin_ && !complex_.planes.infimaximal(plane);
    for (std::size_t part = 0; part < 2; ++part) {
      if (part == 1 && finite) {
        for (std::size_t i = 4; i < 7; ++i) mpz_set_ui(meeting_[i].get_mpz_t(), 0);
        break;
      }
      mpz_mul(s, complex_.planes.coefficient(plane, 3 + part), w);
      for (std::size_t i = 0; i < 3; ++i) {
        mpz_addmul(s, complex_.planes.coefficient(plane, i), ray_.origin.coordinate(4 * part + i));
      }
      for (std::size_t i = 0; i < 3; ++i) {
        mpz_ptr out = meeting_[4 * part + i].get_mpz_t();
        mpz_mul(out, m, ray_.origin.coordinate(4 * part + i));
        if (sgn(d[i]) != 0) mpz_submul(out, s, d[i].get_mpz_t());
      }
    }
    mpz_mul(meeting_[3].get_mpz_t(), m, w);
    if (scratch_.size() == 0) scratch_.reserve(4);
    return PointRef{&scratch_, scratch_.push_homogeneous(meeting_)};
  }

  [[nodiscard]] bool nearer(const PointRef& point) const {
    return compare_coordinate(point, position_, static_cast<int>(filter_.main_axis()), monitor_) * filter_.main_sign() >
           0;
  }

  void offer(const ComplexHit& hit, const PointRef& position) {
    if (hit_ && !nearer(position)) return;
    if (accept_ && !accept_(hit)) return;
    hit_ = hit;
    position_ = position;
    filter_.cut(mirrored(point_box(position)));
  }

  // The sface of the hit's sphere map that holds the direction back to the origin.
  [[nodiscard]] SFaceId entered_through(const ComplexHit& hit) const {
    if (hit.kind == ComplexHit::Kind::kFacet) return {};
    const Direction back = ray_.direction.negated();
    if (hit.kind == ComplexHit::Kind::kVertex) {
      const SphereLocation place = locate(complex_.planes, complex_.sphere_map(hit.vertex()), back, monitor_);
      return place.kind == SphereLocation::Kind::kSFace ? complex_.vertices[hit.vertex()].sfaces + place.index
                                                        : SFaceId();
    }
    const VertexId vertex = complex_.source(hit.halfedge());
    const SphereMapView map = complex_.sphere_map(vertex);
    const VertexRecord& record = complex_.vertices[vertex];
    const SVertex& edge = complex_.svertex(hit.halfedge());
    if (edge.out == kNone) return record.sfaces + edge.sface;
    const Direction axis = direction_of(complex_.planes, edge);
    const Wedge wedge =
        locate_wedge(complex_.planes, map, hit.halfedge() - record.svertices, Direction::cross(axis, back), monitor_);
    return wedge.on ? SFaceId() : record.sfaces + map.shalfedges[wedge.shalfedge].sface;
  }

  const Complex& complex_;
  const QueryStructure& structure_;
  const QueryRay& ray_;
  const QueryStructure::Accept& accept_;
  Monitor monitor_;
  RayFilter filter_;  // mirrored at the origin, like the tree of a QueryStructure
  bool finite_origin_;
  PointTable scratch_;
  Integer slope_, height_;  // of the plane at hand along the ray and at its origin; kept for their memory, as the next
  std::array<Integer, 7> meeting_;
  std::optional<ComplexHit> hit_;
  PointRef position_;
};

std::optional<ComplexHit> QueryStructure::first_hit(const Complex& complex, const QueryRay& ray, const Accept& accept,
                                                    Rational3* at, const Monitor& monitor) const {
  NEF_ASSERT(!ray.direction.is_zero());
  return RayShooter(complex, *this, ray, accept, monitor).shoot(at);
}

}  // namespace nef

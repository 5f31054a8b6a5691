// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/partition/convex_piece.h"

#include "nef/base/error.h"
#include "nef/location/facet_search.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::planner {
namespace {

PlaneId side_plane(const Complex& complex, const Facet& facet, HalfedgeId halfedge) {
  const SVertex& s = complex.svertex(halfedge);
  return (s.p.row() == facet.plane.row() ? s.q : s.p).unflipped();
}

// True if the facet's angle at the corner is at most a half-turn.
bool convex_at(const Complex& complex, SHalfedgeId corner, const Monitor& monitor) {
  const HalfedgeId out = complex.corner_halfedge(corner);
  const HalfedgeId back = complex.corner_back_halfedge(corner);
  if (out == back) return false;
  const Direction u = direction_of(complex.planes, complex.svertex(out));
  const Direction v = direction_of(complex.planes, complex.svertex(back));
  const int turn = orientation_on_circle(complex.planes, complex.shalfedge_plane[corner], u, v, monitor);
  return turn > 0 || (turn == 0 && !same_direction(u, v, monitor));
}

bool is_convex(const Complex& complex, const Facet& facet, const Monitor& monitor) {
  if (facet.cycle_count != 1) return false;
  for (const SHalfedgeId corner : complex.corners_of(facet)) {
    if (!convex_at(complex, corner, monitor)) return false;
  }
  return true;
}

// Cuts a polygon until no edge of the facet runs through it.
class Cutter {
 public:
  Cutter(const Complex& complex, FacetId f, const PlaneTable& planes, PointTable& points, std::vector<ConvexPiece>& out,
         const Monitor& monitor)
      : complex_(complex), f_(f), planes_(planes), points_(points), out_(out), monitor_(monitor) {}

  void cut(ConvexPiece polygon, std::vector<ConvexPiece> edges) {
    if (edges.empty()) {
      PointTable middle;
      const PointRef at{&middle, middle.push(centre(polygon, points_))};
      if (locate_in_facet(complex_, f_, at, nullptr, monitor_).valid()) out_.push_back(std::move(polygon));
      return;
    }
    const PlaneId plane = edges[edges.size() / 2].q;
    std::vector<ConvexPiece> below;
    std::vector<ConvexPiece> above;
    for (ConvexPiece& edge : edges) {
      SplitPiece part = split(std::move(edge), plane, planes_, points_, monitor_);
      if (part.negative) below.push_back(std::move(*part.negative));
      if (part.positive) above.push_back(std::move(*part.positive));
    }
    SplitPiece halves = split(std::move(polygon), plane, planes_, points_, monitor_);
    mark_seams(halves, plane);
    if (halves.negative) cut(std::move(*halves.negative), std::move(below));
    if (halves.positive) cut(std::move(*halves.positive), std::move(above));
  }

 private:
  static void mark_seams(SplitPiece& halves, PlaneId plane) {
    for (std::optional<ConvexPiece>* half : {&halves.negative, &halves.positive}) {
      if (!*half) continue;
      ConvexPiece& piece = **half;
      for (std::size_t i = 0; i < piece.sides.size(); ++i) {
        if (piece.sides[i].row() == plane.row()) piece.seams[i] = true;
      }
    }
  }

  const Complex& complex_;
  FacetId f_;
  const PlaneTable& planes_;
  PointTable& points_;
  std::vector<ConvexPiece>& out_;
  Monitor monitor_;
};

}  // namespace

void append_facet_pieces(const Complex& complex, FacetId f, CellId cell, const PlaneTable& planes, PointTable& points,
                         const std::array<PlaneId, 6>& box, std::vector<ConvexPiece>& pieces, const Monitor& monitor) {
  const Facet& facet = complex.facets[f];
  if (is_convex(complex, facet, monitor)) {
    ConvexPiece piece;
    piece.cell = cell;
    piece.dimension = 2;
    piece.p = facet.plane;
    for (const SHalfedgeId corner : complex.corners_of(facet)) {
      piece.points.push_back(point_of(complex.shalfedge_vertex(corner)));
      piece.sides.push_back(side_plane(complex, facet, complex.corner_halfedge(corner)));
      piece.seams.push_back(false);
    }
    pieces.push_back(std::move(piece));
    return;
  }
  std::vector<ConvexPiece> edges;
  for (const SHalfedgeId corner : complex.corners_of(facet)) {
    const HalfedgeId halfedge = complex.corner_halfedge(corner);
    ConvexPiece edge;
    edge.dimension = 1;
    edge.p = facet.plane.unflipped();
    edge.q = side_plane(complex, facet, halfedge);
    edge.points = {point_of(complex.source(halfedge)), point_of(complex.target(halfedge))};
    edges.push_back(std::move(edge));
  }
  ConvexPiece whole = plane_in_box(facet.plane, box, planes, points);
  whole.cell = cell;
  Cutter(complex, f, planes, points, pieces, monitor).cut(std::move(whole), std::move(edges));
}

}  // namespace nef::planner

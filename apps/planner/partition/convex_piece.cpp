// SPDX-License-Identifier: Apache-2.0
//
// A polygon is split in one walk around it: vertices go to the half of their sign, and an edge whose ends differ in
// sign contributes the point in which its two planes and the cutting plane meet. Convexity leaves exactly two points in
// the cut. O(n) signs for n vertices.
#include "apps/planner/partition/convex_piece.h"

#include <algorithm>
#include <cmath>

#include "apps/planner/partition/exact_point.h"
#include "nef/base/error.h"
#include "nef/geometry/predicates.h"

namespace nef::planner {
namespace {

PointId meeting(PlaneId p, PlaneId q, PlaneId r, const PlaneTable& planes, PointTable& points) {
  const std::optional<PointId> point = points.push_intersection(planes, p, q, r);
  NEF_ASSERT(point.has_value());
  return *point;
}

ConvexPiece point_piece(CellId cell, PointId point) {
  ConvexPiece piece;
  piece.cell = cell;
  piece.points = {point};
  return piece;
}

SplitPiece split_segment(ConvexPiece&& piece, int first, int second, PlaneId plane, const PlaneTable& planes,
                         PointTable& points) {
  SplitPiece result;
  if (first == 0 && second == 0) {
    result.on = std::move(piece);
    return result;
  }
  if (first * second >= 0) {
    if (first == 0) result.on = point_piece(piece.cell, piece.points[0]);
    if (second == 0) result.on = point_piece(piece.cell, piece.points[1]);
    (first + second > 0 ? result.positive : result.negative) = std::move(piece);
    return result;
  }
  const PointId middle = meeting(piece.p, piece.q, plane, planes, points);
  result.on = point_piece(piece.cell, middle);
  ConvexPiece other = piece;
  piece.points[1] = middle;
  other.points[0] = middle;
  (first > 0 ? result.positive : result.negative) = std::move(piece);
  (first > 0 ? result.negative : result.positive) = std::move(other);
  return result;
}

// Collects one half of a polygon while walking around it.
struct Half {
  ConvexPiece piece;
  void add(PointId point, PlaneId side, bool seam) {
    piece.points.push_back(point);
    piece.sides.push_back(side);
    piece.seams.push_back(seam);
  }
};

SplitPiece touch_polygon(ConvexPiece&& piece, const std::vector<int>& signs, int sign, PlaneId plane) {
  SplitPiece result;
  const std::size_t n = signs.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (signs[i] != 0 || signs[(i + 1) % n] != 0 || !piece.seams[i]) continue;
    ConvexPiece edge;
    edge.cell = piece.cell;
    edge.dimension = 1;
    edge.p = piece.p;
    edge.q = plane;
    edge.points = {piece.points[i], piece.points[(i + 1) % n]};
    result.on = std::move(edge);
  }
  (sign > 0 ? result.positive : result.negative) = std::move(piece);
  return result;
}

SplitPiece split_polygon(ConvexPiece&& piece, const std::vector<int>& signs, PlaneId plane, const PlaneTable& planes,
                         PointTable& points) {
  const std::size_t n = signs.size();
  Half negative;
  Half positive;
  std::vector<PointId> cut;
  for (std::size_t i = 0; i < n; ++i) {
    const int here = signs[i];
    const int next = signs[(i + 1) % n];
    const PointId point = piece.points[i];
    const PlaneId side = piece.sides[i];
    const bool seam = piece.seams[i];
    if (here == 0) {
      cut.push_back(point);
      // The half that the boundary leaves is closed along the cutting plane.
      negative.add(point, next < 0 ? side : plane, next < 0 && seam);
      positive.add(point, next > 0 ? side : plane, next > 0 && seam);
      continue;
    }
    Half& mine = here < 0 ? negative : positive;
    mine.add(point, side, seam);
    if (here * next >= 0) continue;
    const PointId crossing = meeting(piece.p, side, plane, planes, points);
    cut.push_back(crossing);
    mine.add(crossing, plane, false);
    (here < 0 ? positive : negative).add(crossing, side, seam);
  }
  NEF_ASSERT(cut.size() == 2);
  SplitPiece result;
  ConvexPiece on;
  on.cell = piece.cell;
  on.dimension = 1;
  on.p = piece.p;
  on.q = plane;
  on.points = cut;
  result.on = std::move(on);
  for (Half* half : {&negative, &positive}) {
    half->piece.cell = piece.cell;
    half->piece.dimension = 2;
    half->piece.p = piece.p;
  }
  result.negative = std::move(negative.piece);
  result.positive = std::move(positive.piece);
  return result;
}

}  // namespace

SplitPiece split(ConvexPiece&& piece, PlaneId plane, const PlaneTable& planes, PointTable& points,
                 const Monitor& monitor) {
  const PlaneId positive = plane.unflipped();
  SplitPiece result;
  if (piece.dimension > 0 && (piece.p.row() == plane.row() || (piece.dimension == 1 && piece.q.row() == plane.row()))) {
    result.on = std::move(piece);
    return result;
  }
  std::vector<int> signs;
  signs.reserve(piece.points.size());
  bool above = false;
  bool below = false;
  for (const PointId point : piece.points) {
    signs.push_back(side_of_plane(planes, positive, points, point, monitor));
    above = above || signs.back() > 0;
    below = below || signs.back() < 0;
  }
  if (!above && !below) {
    result.on = std::move(piece);
  } else if (piece.dimension == 1) {
    return split_segment(std::move(piece), signs[0], signs[1], plane, planes, points);
  } else if (above && below) {
    return split_polygon(std::move(piece), signs, plane, planes, points);
  } else if (piece.dimension == 2) {
    return touch_polygon(std::move(piece), signs, above ? 1 : -1, plane);
  } else {
    (above ? result.positive : result.negative) = std::move(piece);
  }
  return result;
}

ConvexPiece plane_in_box(PlaneId plane, const std::array<PlaneId, 6>& box, const PlaneTable& planes,
                         PointTable& points) {
  const std::array<double, 4>& n = planes.approximate(plane);
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::fabs(n[i]) > std::fabs(n[axis])) axis = i;
  }
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const std::array<PlaneId, 4> around{box[2 * v], box[2 * u + 1], box[2 * v + 1], box[2 * u]};
  ConvexPiece piece;
  piece.dimension = 2;
  piece.p = plane.unflipped();
  for (std::size_t i = 0; i < 4; ++i) {
    piece.points.push_back(meeting(piece.p, around[(i + 3) % 4], around[i], planes, points));
    piece.sides.push_back(around[i]);
    piece.seams.push_back(false);
  }
  return piece;
}

Rational3 centre(const ConvexPiece& piece, const PointTable& points) {
  std::vector<Rational3> corners;
  for (const PointId point : piece.points) corners.push_back(points.rational(point));
  return mean_of(corners);
}

}  // namespace nef::planner

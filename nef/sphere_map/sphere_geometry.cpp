// SPDX-License-Identifier: Apache-2.0
//
// Point location walks along a great circle from the query to some svertex of the map and looks
// at what it meets first. The segment is shorter than a half circle, so it crosses any other
// great circle at most once, and the side of that circle on which the query lies is the side from
// which the walk arrives.
#include "nef/sphere_map/sphere_geometry.h"

#include <optional>

#include "nef/base/defect.h"

namespace nef {

bool strictly_between_on_circle(const PlaneTable& planes, PlaneId plane, const Direction& s, const Direction& x,
                                const Direction& t, bool full, const Monitor& monitor) {
  if (full) return true;
  // Half-turn of each about s: 0 in (0, pi), 1 at pi, 2 in (pi, 2 pi).
  const int x_turn = 1 - orientation_on_circle(planes, plane, s, x, monitor);
  const int t_turn = 1 - orientation_on_circle(planes, plane, s, t, monitor);
  if (x_turn != t_turn) return x_turn < t_turn;
  if (x_turn == 1) return false;
  return orientation_on_circle(planes, plane, x, t, monitor) > 0;
}

int compare_around(const Direction& d, const Direction& reference, const Direction& n1, const Direction& n2,
                   const Monitor& monitor) {
  // Rank of the angle from the reference: 0 at it, 1 in (0, pi), 2 at pi, 3 in (pi, 2 pi).
  const auto rank = [&](const Direction& n) {
    const int turn =
        n.p.valid() && !n.q.valid() && reference.p.valid() && !reference.q.valid() && n.p.row() == reference.p.row()
            ? 0
            : sign_of_determinant(d, reference, n, monitor);
    if (turn != 0) return turn > 0 ? 1 : 3;
    return sign_of_dot(reference, n, monitor) > 0 ? 0 : 2;
  };
  const int rank1 = rank(n1);
  const int rank2 = rank(n2);
  if (rank1 != rank2) return rank1 < rank2 ? -1 : 1;
  if (rank1 == 0 || rank1 == 2) return 0;
  return -sign_of_determinant(d, n1, n2, monitor);
}

Wedge locate_wedge(const PlaneTable& planes, const SphereMapView& map, std::uint32_t svertex, const Direction& normal,
                   const Monitor& monitor) {
  const std::uint32_t first = map.svertices[svertex].out;
  detail::require(first != kNone, "an svertex with facets has a shalfedge", {{"svertex", svertex}});
  const Direction axis = direction_of(planes, map.svertices[svertex]);
  const Direction reference = Direction::normal(planes, map.shalfedges[first].plane);
  Wedge result{first, compare_around(axis, reference, reference, normal, monitor) == 0};
  if (result.on) return result;
  for (std::uint32_t e = map.next_around(first); e != first; e = map.next_around(e)) {
    const Direction n = Direction::normal(planes, map.shalfedges[e].plane);
    const int order = compare_around(axis, reference, n, normal, monitor);
    if (order > 0) break;
    result = {e, order == 0};
    if (result.on) break;
  }
  return result;
}

namespace {

struct FirstHit {
  std::optional<Direction> at;
  bool is_vertex = false;
  std::uint32_t index = kNone;
};

// What the open walk from `from` to svertex `goal` meets first; the goal itself counts.
FirstHit walk(const PlaneTable& planes, const SphereMapView& map, const Direction& from, std::uint32_t goal,
              const Monitor& monitor) {
  const Direction to = direction_of(planes, map.svertices[goal]);
  const Direction circle = Direction::cross(from, to);
  FirstHit hit{to, true, goal};
  const auto offer = [&](Direction&& at, bool is_vertex, std::uint32_t index) {
    if (sign_of_determinant(circle, at, *hit.at, monitor) > 0) hit = {std::move(at), is_vertex, index};
  };
  for (std::uint32_t i = 0; i < map.svertices.size(); ++i) {
    if (i == goal) continue;
    Direction v = direction_of(planes, map.svertices[i]);
    if (sign_of_dot(circle, v, monitor) != 0 || sign_of_determinant(circle, from, v, monitor) <= 0) continue;
    offer(std::move(v), true, i);
  }
  for (std::uint32_t i = 0; i < map.shalfedges.size(); i += 2) {
    const SHalfedge& arc = map.shalfedges[i];
    const Direction n = Direction::normal(planes, arc.plane);
    const int side_from = sign_of_dot(n, from, monitor);
    const int side_to = sign_of_dot(n, to, monitor);
    if (side_from * side_to >= 0) continue;
    // Going counterclockwise on `circle` from the positive to the negative side of n, one crosses
    // at circle x n; the other way at its antipode.
    Direction x = Direction::cross(circle, n);
    if (side_from < 0) x = x.negated();
    const std::uint32_t t = map.target(i);
    const Direction source = direction_of(planes, map.svertices[arc.source]);
    const Direction target = direction_of(planes, map.svertices[t]);
    if (same_direction(x, source, monitor) || same_direction(x, target, monitor)) continue;  // met as an svertex
    if (!strictly_between_on_circle(planes, arc.plane, source, x, target, arc.source == t, monitor)) continue;
    offer(std::move(x), false, side_from > 0 ? i : i + 1);
  }
  return hit;
}

}  // namespace

SphereLocation locate(const PlaneTable& planes, const SphereMapView& map, const Direction& direction,
                      const Monitor& monitor) {
  using Kind = SphereLocation::Kind;
  if (!map.sloops.empty()) {
    const int side = side_of_circle(planes, map.sloops[0].plane, direction, monitor);
    if (side == 0) return {Kind::kSLoop, 0};
    // With a sloop present, everything else lies off its circle; if nothing else is there, the
    // side decides.
    if (map.svertices.empty()) return {Kind::kSFace, map.sloops[side > 0 ? 0 : 1].sface};
  }
  if (map.svertices.empty()) return {Kind::kSFace, 0};
  std::uint32_t goal = kNone;
  const Direction antipode = direction.negated();
  for (std::uint32_t i = 0; i < map.svertices.size(); ++i) {
    const Direction v = direction_of(planes, map.svertices[i]);
    if (same_direction(v, direction, monitor)) return {Kind::kSVertex, i};
    if (goal == kNone && !same_direction(v, antipode, monitor)) goal = i;
  }
  for (std::uint32_t i = 0; i < map.shalfedges.size(); i += 2) {
    const SHalfedge& arc = map.shalfedges[i];
    if (side_of_circle(planes, arc.plane, direction, monitor) != 0) continue;
    const std::uint32_t t = map.target(i);
    const Direction source = direction_of(planes, map.svertices[arc.source]);
    const Direction target = direction_of(planes, map.svertices[t]);
    if (strictly_between_on_circle(planes, arc.plane, source, direction, target, arc.source == t, monitor)) {
      return {Kind::kSHalfedge, i};
    }
  }
  if (!map.sloops.empty()) {
    // The walk may have to cross the loop's circle: then the loop may be what it meets first, and
    // an svertex on the query's own side is a better goal. If there is none, the loop bounds.
    const int side = side_of_circle(planes, map.sloops[0].plane, direction, monitor);
    std::uint32_t same_side = kNone;
    for (std::uint32_t i = 0; i < map.svertices.size() && same_side == kNone; ++i) {
      if (side_of_circle(planes, map.sloops[0].plane, direction_of(planes, map.svertices[i]), monitor) == side)
        same_side = i;
    }
    if (same_side == kNone) return {Kind::kSFace, map.sloops[side > 0 ? 0 : 1].sface};
    goal = same_side;
  }
  if (goal == kNone) {
    // The antipode is the only svertex and no arc reaches the query: it is isolated.
    return {Kind::kSFace, map.svertices[0].sface};
  }
  const FirstHit hit = walk(planes, map, direction, goal, monitor);
  if (!hit.is_vertex) return {Kind::kSFace, map.shalfedges[hit.index].sface};
  if (map.svertices[hit.index].out == kNone) return {Kind::kSFace, map.svertices[hit.index].sface};
  const Wedge wedge = locate_wedge(planes, map, hit.index, Direction::cross(*hit.at, direction), monitor);
  detail::require(!wedge.on, "arcs of a sphere map meet in svertices only", {{"svertex", hit.index}});
  return {Kind::kSFace, map.shalfedges[wedge.shalfedge].sface};
}

LabelId mark_at(const SphereMapView& map, const SphereLocation& location) {
  switch (location.kind) {
    case SphereLocation::Kind::kSVertex:
      return map.svertices[location.index].mark;
    case SphereLocation::Kind::kSHalfedge:
      return map.shalfedges[location.index].mark;
    case SphereLocation::Kind::kSLoop:
      return map.sloops[location.index].mark;
    case SphereLocation::Kind::kSFace:
      break;
  }
  return map.sfaces[location.index].mark;
}

}  // namespace nef

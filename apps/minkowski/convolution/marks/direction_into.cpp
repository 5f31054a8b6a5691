// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/marks/direction_into.h"

#include "nef/base/error.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::minkowski {
namespace {

std::size_t bits(const Integer3& v) {
  std::size_t most = 0;
  for (const Integer& x : v) most = std::max(most, mpz_sizeinbase(x.get_mpz_t(), 2));
  return most;
}

Direction direction(const Integer3& v) { return Direction::exact(v[0], v[1], v[2]); }

// A u 2^i + B v 2^j, so that both are about as long, the second one shorter by 2^ratio.
Integer3 mean(const Integer3& u, const Integer3& v, std::size_t ratio) {
  const std::size_t a = bits(u) + ratio;
  const std::size_t b = bits(v) + 2 * ratio;
  Integer3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = b > a ? Integer((u[i] << (b - a)) + v[i]) : Integer(u[i] + (v[i] << (a - b)));
  }
  return result;
}

// A direction inside an arc.
Integer3 inside_arc(const PlaneTable& planes, const SphereMapView& map, std::uint32_t shalfedge,
                    const Monitor& monitor) {
  const PlaneId plane = map.shalfedges[shalfedge].plane;
  const Direction from = direction_of(planes, map.svertices[map.shalfedges[shalfedge].source]);
  const Direction to = direction_of(planes, map.svertices[map.target(shalfedge)]);
  if (orientation_on_circle(planes, plane, from, to, monitor) > 0) return mean(from.integers(), to.integers(), 0);
  return Direction::cross(Direction::normal(planes, plane), from).integers();  // a quarter-turn on, of a half or more
}

// Any direction in a plane.
Integer3 inside_circle(const PlaneTable& planes, PlaneId plane) {
  const Integer3 n = Direction::normal(planes, plane).integers();
  if (n[0] != 0 || n[1] != 0) return {Integer(-n[1]), n[0], Integer(0)};
  return {Integer(1), Integer(0), Integer(0)};
}

// Off the arc or circle of a plane to its left, less and less.
Direction beside(const PlaneTable& planes, const SphereMapView& map, std::uint32_t sface, PlaneId plane,
                 const Integer3& on_side, const Monitor& monitor) {
  const Integer3 normal = Direction::normal(planes, plane).integers();
  for (std::size_t ratio = 1;; ratio += ratio) {
    Direction candidate = direction(mean(on_side, normal, ratio));
    const SphereLocation at = locate(planes, map, candidate, monitor);
    if (at.kind == SphereLocation::Kind::kSFace && at.index == sface) return candidate;
  }
}

}  // namespace

Direction direction_into(const PlaneTable& planes, const SphereMapView& map, std::uint32_t sface,
                         const Monitor& monitor) {
  NEF_ASSERT(map.sfaces[sface].entry_count > 0);
  const SFaceEntry& entry = map.entries[map.sfaces[sface].entries];
  NEF_ASSERT(entry.kind != SFaceEntry::Kind::kIsolatedVertex);  // drawings of arcs have none
  if (entry.kind == SFaceEntry::Kind::kCycle) return direction_into(planes, map, sface, entry.index, monitor);
  const PlaneId plane = map.sloops[entry.index].plane;
  return beside(planes, map, sface, plane, inside_circle(planes, plane), monitor);
}

Direction direction_into(const PlaneTable& planes, const SphereMapView& map, std::uint32_t sface,
                         std::uint32_t shalfedge, const Monitor& monitor) {
  return beside(planes, map, sface, map.shalfedges[shalfedge].plane, inside_arc(planes, map, shalfedge, monitor),
                monitor);
}

Direction direction_on_arc(const PlaneTable& planes, const SphereMapView& map, std::uint32_t shalfedge,
                           const Monitor& monitor) {
  return direction(inside_arc(planes, map, shalfedge, monitor));
}

Direction direction_on_circle(const PlaneTable& planes, PlaneId plane) {
  return direction(inside_circle(planes, plane));
}

}  // namespace nef::minkowski

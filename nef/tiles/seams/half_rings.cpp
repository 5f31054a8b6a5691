// SPDX-License-Identifier: Apache-2.0
#include "nef/tiles/seams/half_rings.h"

#include <algorithm>

#include "nef/sphere_map/sphere_geometry.h"

namespace nef {

bool HalfRings::read(const SphereMapView& map, std::uint32_t wall, Path& path) {
  const std::size_t n = map.svertices.size();
  if (n < 2 || map.shalfedges.size() != 2 * (n + 1) || map.sfaces.size() != 3 || map.entries.size() != 3 ||
      !map.sloops.empty()) {
    return false;
  }
  std::array<std::uint32_t, 2> ends{kNone, kNone};
  std::size_t in_wall = 0;
  for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
    const SHalfedge half = map.shalfedges[e];
    if (half.plane.row() != wall) continue;
    const std::uint32_t target = map.target(e);
    const std::array<std::uint32_t, 2> here{std::min(half.source, target), std::max(half.source, target)};
    if (in_wall++ > 0 && here != ends) return false;
    ends = here;
    const LabelId left = map.sfaces[half.sface].mark;
    const LabelId right = map.sfaces[map.shalfedges[e + 1].sface].mark;
    if ((left == kOutside) == (right == kOutside) || half.mark != (left == kOutside ? right : left)) return false;
  }
  if (in_wall != 2 || ends[0] == ends[1]) return false;
  std::uint32_t e = map.svertices[ends[0]].out;
  for (std::size_t k = 0; map.shalfedges[e].plane.row() == wall; ++k) {
    if (k == 2) return false;
    e = map.next_around(e);
  }
  const std::uint32_t sface = map.shalfedges[e].sface;
  path.left = map.sfaces[sface].mark;
  path.right = map.sfaces[map.shalfedges[e ^ 1U].sface].mark;
  if (path.left == path.right || path.left == kOutside || path.right == kOutside) return false;
  path.arcs.assign(1, e);
  while (map.target(e) != ends[1]) {
    const std::uint32_t next = map.shalfedges[e].next;
    if (path.arcs.size() == n || map.shalfedges[e ^ 1U].prev != (next ^ 1U)) return false;  // other arcs arrive there
    path.arcs.push_back(next);
    e = next;
  }
  return path.arcs.size() == n - 1;
}

void HalfRings::turn_around(Path& path) {
  std::reverse(path.arcs.begin(), path.arcs.end());
  for (std::uint32_t& arc : path.arcs) arc ^= 1U;
  std::swap(path.left, path.right);
}

bool HalfRings::join(const PlaneTable& planes, std::uint32_t wall, const SphereMapView& one, const SphereMapView& other,
                     SphereMapBuffer& out, const Monitor& monitor) {
  if (!read(one, wall, paths_[0]) || !read(other, wall, paths_[1])) return false;
  if (paths_[1].left != paths_[0].left) turn_around(paths_[1]);
  if (paths_[1].left != paths_[0].left || paths_[1].right != paths_[0].right || one.mark != other.mark) return false;
  out.clear();
  out.mark = one.mark;
  const std::array<const SphereMapView*, 2> maps{&one, &other};
  for (std::size_t k = 0; k < 2; ++k) {
    const SphereMapView& map = *maps[k];
    const SphereMapView& before = *maps[1 - k];
    const SHalfedge arriving = before.shalfedges[paths_[1 - k].arcs.back()];
    for (const std::uint32_t arc : paths_[k].arcs) {
      const SHalfedge half = map.shalfedges[arc];
      SVertex source = map.svertices[half.source];
      if (arc == paths_[k].arcs.front()) {
        if (half.plane.row() == arriving.plane.row()) {
          if (half.plane != arriving.plane || half.mark != arriving.mark || source.mark != half.mark) return false;
          continue;  // the last arc of the other path goes on as this one
        }
        const int sign = sign_of_dot(Direction::cross(planes, source.p, source.q),
                                     Direction::cross(planes, arriving.plane, half.plane), monitor);
        source.p = arriving.plane;
        source.q = sign > 0 ? half.plane : half.plane.opposite();
      }
      source.sface = kNone;
      out.svertices.push_back(source);
      out.shalfedges.push_back(half);
      out.shalfedges.push_back(map.shalfedges[arc ^ 1U]);
    }
  }
  const auto n = static_cast<std::uint32_t>(out.svertices.size());
  if (n < 3) return false;
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = i + 1 == n ? 0 : i + 1;
    const std::uint32_t before = i == 0 ? n - 1 : i - 1;
    out.svertices[i].out = 2 * i;
    SHalfedge& left = out.shalfedges[2 * std::size_t{i}];
    SHalfedge& right = out.shalfedges[2 * std::size_t{i} + 1];
    left.source = i;
    left.next = 2 * next;
    left.prev = 2 * before;
    left.sface = 0;
    right.source = next;
    right.next = 2 * before + 1;
    right.prev = 2 * next + 1;
    right.sface = 1;
  }
  out.sfaces = {{0, 1, paths_[0].left}, {1, 1, paths_[0].right}};
  out.entries = {{SFaceEntry::Kind::kCycle, 0}, {SFaceEntry::Kind::kCycle, 1}};
  return true;
}

}  // namespace nef

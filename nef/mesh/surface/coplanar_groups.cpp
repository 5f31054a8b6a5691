// SPDX-License-Identifier: Apache-2.0
//
// Sides are sorted by their two corners; a side of exactly two polygons joins them (union-find) if the second one lies
// in the plane of the first, on the other side of the common edge. The border of a group is strung together from the
// sides that are not inner ones, and tested: one cycle turns like the members, and no two sides meet other than in a
// corner between neighbours, which a tree of boxes finds.
#include "nef/mesh/surface/coplanar_groups.h"

#include <algorithm>
#include <array>

#include "nef/base/union_find.h"
#include "nef/mesh/edge_order.h"
#include "nef/mesh/polygon/simple_ring.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef {
namespace {

struct PolygonSide {
  std::uint64_t key = 0;  // smaller corner, larger corner
  std::uint32_t polygon = 0;
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  bool inner = false;  // between two polygons of a group
};

class Grouper {
 public:
  Grouper(const MeshPoints& points, const std::vector<std::span<const std::uint32_t>>& polygons, const Monitor& monitor)
      : points_(points), polygons_(polygons), monitor_(monitor), joined_(polygons.size()) {}

  std::vector<CoplanarGroup> run() {
    list_sides();
    for (std::size_t first = 0, last = 0; first < sides_.size(); first = last) {
      while (last < sides_.size() && sides_[last].key == sides_[first].key) ++last;
      if (last - first == 2) join(sides_[first], sides_[first + 1]);
    }
    return collect();
  }

 private:
  void list_sides() {
    std::size_t count = 0;
    for (const auto& ring : polygons_) count += ring.size();
    sides_.reserve(count);
    for (std::uint32_t p = 0; p < polygons_.size(); ++p) {
      const std::span<const std::uint32_t> ring = polygons_[p];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t u = ring[i];
        const std::uint32_t v = ring[i + 1 == ring.size() ? 0 : i + 1];
        sides_.push_back({edge_key(u, v), p, u, v, false});
      }
    }
    sort_by_pair(sides_, points_.size());
  }

  // A corner of the polygon off the line of a side: convex strictly, it has no other there.
  std::uint32_t corner_beside(const PolygonSide& side) const {
    for (const std::uint32_t v : polygons_[side.polygon]) {
      if (v != side.from && v != side.to) return v;
    }
    return side.from;
  }

  void join(PolygonSide& a, PolygonSide& b) {
    if (a.from != b.to) return;
    const std::uint32_t p = corner_beside(a);
    const std::uint32_t q = corner_beside(b);
    if (points_.orientation(a.from, a.to, p, q, monitor_) != 0) return;
    const std::size_t axis = points_.projection_axis(a.from, a.to, p, monitor_);
    if (points_.orientation_along(a.from, a.to, p, axis, monitor_) ==
        points_.orientation_along(a.from, a.to, q, axis, monitor_))
      return;
    a.inner = b.inner = true;
    joined_.unite(a.polygon, b.polygon);
  }

  std::vector<CoplanarGroup> collect() {
    const auto count = static_cast<std::uint32_t>(polygons_.size());
    std::vector<std::uint32_t> size(count, 0);
    for (std::uint32_t p = 0; p < count; ++p) ++size[joined_.find(p)];
    std::vector<std::uint32_t> number(count, 0);  // of the group of a root
    std::vector<CoplanarGroup> groups;
    std::vector<std::vector<std::array<std::uint32_t, 2>>> borders;
    for (std::uint32_t p = 0; p < count; ++p) {
      const std::uint32_t root = joined_.find(p);
      if (size[root] < 2) continue;
      if (root == p) {
        number[p] = static_cast<std::uint32_t>(groups.size());
        groups.emplace_back();
      }
      groups[number[root]].members.push_back(p);
    }
    borders.resize(groups.size());
    for (const PolygonSide& side : sides_) {
      const std::uint32_t root = joined_.find(side.polygon);
      if (size[root] > 1 && !side.inner) borders[number[root]].push_back({side.from, side.to});
    }
    std::size_t kept = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (!trace(std::move(borders[g]), groups[g]) || !simple(groups[g])) continue;
      if (kept != g) groups[kept] = std::move(groups[g]);
      ++kept;
    }
    groups.resize(kept);
    return groups;
  }

  // Strings the sides of a border to cycles; false if more than two of them meet in a corner.
  static bool trace(std::vector<std::array<std::uint32_t, 2>> border, CoplanarGroup& group) {
    std::sort(border.begin(), border.end());
    const auto same_start = [](const auto& a, const auto& b) { return a[0] == b[0]; };
    if (std::adjacent_find(border.begin(), border.end(), same_start) != border.end()) return false;
    std::vector<bool> done(border.size(), false);
    for (std::size_t first = 0; first < border.size(); ++first) {
      for (std::size_t i = first; !done[i];) {
        done[i] = true;
        group.cycles.push_back(border[i][0]);
        const auto next = std::lower_bound(border.begin(), border.end(), std::array<std::uint32_t, 2>{border[i][1], 0});
        // As often as a border arrives at a corner it leaves it.
        i = static_cast<std::size_t>(next - border.begin());
      }
      if (group.cycle_end.empty() || group.cycle_end.back() < group.cycles.size()) {
        group.cycle_end.push_back(static_cast<std::uint32_t>(group.cycles.size()));
      }
    }
    return true;
  }

  // True if no two sides of the border meet but in the corner between neighbours, and only one cycle is turned like the
  // members: a plane set's border has one outer cycle for each of its parts, and the other cycles run the other way.
  bool simple(const CoplanarGroup& group) const {
    const std::span<const std::uint32_t> first = polygons_[group.members[0]];
    const std::size_t axis = points_.projection_axis(first[0], first[1], first[2], monitor_);
    const int turn = points_.orientation_along(first[0], first[1], first[2], axis, monitor_);
    std::size_t outer = 0;
    for (std::uint32_t begin = 0; const std::uint32_t end : group.cycle_end) {
      const std::vector<std::uint32_t> ring(group.cycles.begin() + begin, group.cycles.begin() + end);
      if (ring_orientation(points_, ring, axis, monitor_) == turn) ++outer;
      begin = end;
    }
    return outer == 1 && !sides_that_meet(points_, group.cycles, group.cycle_end, axis, monitor_);
  }

  const MeshPoints& points_;
  const std::vector<std::span<const std::uint32_t>>& polygons_;
  Monitor monitor_;
  UnionFind joined_;
  std::vector<PolygonSide> sides_;
};

}  // namespace

std::vector<CoplanarGroup> coplanar_groups(const MeshPoints& points,
                                           const std::vector<std::span<const std::uint32_t>>& polygons,
                                           const Monitor& monitor) {
  return Grouper(points, polygons, monitor).run();
}

}  // namespace nef

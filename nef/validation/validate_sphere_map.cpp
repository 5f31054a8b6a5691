// SPDX-License-Identifier: Apache-2.0
//
// The invariants of one sphere map (nef/sphere_map/sphere_map.h), each under its own name. Index ranges and links come
// first, since all later checks follow them. Then geometry: directions on their circles, arcs in cyclic order around
// svertices, and each pair of arcs tested for a crossing, which is O(k^2) and uses no overlay, so that the overlay's
// mistakes are found. Euler's formula confirms that the sfaces are right, and the last check that the map is
// simplified.
#include <vector>

#include "nef/base/union_find.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/validation/validate.h"

namespace nef {
namespace {

using detail::require;

class SphereMapChecker {
 public:
  SphereMapChecker(const PlaneTable& planes, const SphereMapView& map, const Monitor& monitor)
      : planes_(planes), map_(map), monitor_(monitor) {}

  void run() {
    check_ranges();
    check_links();
    for (const SVertex& v : map_.svertices) directions_.push_back(direction_of(planes_, v));
    check_directions();
    check_order_around_svertices();
    check_arcs_are_disjoint();
    check_sloop_is_free();
    check_entries();
    check_euler();
    check_simplified();
  }

 private:
  void check_ranges() const {
    const auto plane_ok = [this](PlaneId plane) { return plane.valid() && plane.row() < planes_.size(); };
    const std::size_t svertices = map_.svertices.size();
    const std::size_t arcs = map_.shalfedges.size();
    const std::size_t sfaces = map_.sfaces.size();
    require(arcs % 2 == 0, "shalfedges come in pairs", {});
    require(map_.sloops.empty() || map_.sloops.size() == 2, "at most one sloop with its twin", {});
    require(sfaces > 0, "a sphere has an sface", {});
    for (std::size_t i = 0; i < svertices; ++i) {
      const SVertex& v = map_.svertices[i];
      require(plane_ok(v.p) && plane_ok(v.q), "planes of an svertex exist", {{"svertex", i}});
      require(v.p.row() != v.q.row(), "planes of an svertex differ", {{"svertex", i}});
      require(v.out == kNone ? v.sface < sfaces : v.out < arcs && v.sface == kNone,
              "svertex has either a shalfedge or an sface", {{"svertex", i}});
    }
    for (std::size_t i = 0; i < arcs; ++i) {
      const SHalfedge& e = map_.shalfedges[i];
      require(plane_ok(e.plane), "plane of a shalfedge exists", {{"shalfedge", i}});
      require(e.source < svertices && e.next < arcs && e.prev < arcs && e.sface < sfaces,
              "indices of a shalfedge in range", {{"shalfedge", i}});
    }
    for (std::size_t i = 0; i < map_.sloops.size(); ++i) {
      require(plane_ok(map_.sloops[i].plane) && map_.sloops[i].sface < sfaces, "indices of a sloop in range",
              {{"sloop", i}});
    }
    for (std::size_t i = 0; i < sfaces; ++i) {
      const SFace& f = map_.sfaces[i];
      require(f.entries <= map_.entries.size() && f.entry_count <= map_.entries.size() - f.entries,
              "entries of an sface in range", {{"sface", i}});
    }
  }

  void check_links() const {
    for (std::uint32_t i = 0; i < map_.shalfedges.size(); ++i) {
      const SHalfedge& e = map_.shalfedges[i];
      const SHalfedge& twin = map_.shalfedges[i ^ 1U];
      require(twin.plane == e.plane.opposite(), "twin shalfedges have opposite planes", {{"shalfedge", i}});
      require(twin.mark == e.mark, "twin shalfedges have one mark", {{"shalfedge", i}});
      require(map_.shalfedges[e.next].prev == i && map_.shalfedges[e.prev].next == i, "next and prev are inverse",
              {{"shalfedge", i}});
      require(map_.shalfedges[e.next].source == twin.source, "next starts where a shalfedge ends", {{"shalfedge", i}});
      require(map_.shalfedges[e.next].sface == e.sface, "one sface along a boundary cycle", {{"shalfedge", i}});
      require(map_.svertices[e.source].out != kNone, "an svertex with arcs knows one", {{"svertex", e.source}});
    }
    for (std::uint32_t i = 0; i < map_.svertices.size(); ++i) {
      const std::uint32_t out = map_.svertices[i].out;
      require(out == kNone || map_.shalfedges[out].source == i, "out starts at its svertex", {{"svertex", i}});
    }
    if (!map_.sloops.empty()) {
      require(map_.sloops[0].plane == map_.sloops[1].plane.opposite(), "twin sloops have opposite planes", {});
      require(map_.sloops[0].mark == map_.sloops[1].mark, "twin sloops have one mark", {});
    }
  }

  void check_directions() const {
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      require(!directions_[i].is_zero(), "planes of an svertex are not parallel", {{"svertex", i}});
      for (std::size_t j = 0; j < i; ++j) {
        require(!same_direction(directions_[i], directions_[j], monitor_), "svertices are distinct",
                {{"svertex", j}, {"svertex", i}});
      }
    }
    for (std::size_t i = 0; i < map_.shalfedges.size(); ++i) {
      const SHalfedge& e = map_.shalfedges[i];
      require(sign_of_dot(Direction::normal(planes_, e.plane), directions_[e.source], monitor_) == 0,
              "source of a shalfedge lies on its great circle", {{"shalfedge", i}, {"svertex", e.source}});
    }
  }

  // One full turn, strictly increasing angles: every arc that leaves is met exactly once.
  void check_order_around_svertices() const {
    std::vector<std::uint32_t> degree(map_.svertices.size(), 0);
    for (const SHalfedge& e : map_.shalfedges) ++degree[e.source];
    for (std::uint32_t v = 0; v < map_.svertices.size(); ++v) {
      const std::uint32_t first = map_.svertices[v].out;
      if (first == kNone) continue;
      const Direction reference = Direction::normal(planes_, map_.shalfedges[first].plane);
      Direction last = reference;
      std::uint32_t met = 1;
      for (std::uint32_t e = map_.next_around(first); e != first; e = map_.next_around(e)) {
        const Direction n = Direction::normal(planes_, map_.shalfedges[e].plane);
        require(compare_around(directions_[v], reference, last, n, monitor_) < 0,
                "arcs lie counterclockwise around an svertex", {{"svertex", v}, {"shalfedge", e}});
        last = n;
        ++met;
      }
      require(met == degree[v], "next_around meets all arcs of an svertex", {{"svertex", v}});
    }
  }

  // x lies on the circle of the arc: is it inside the arc, ends excluded?
  [[nodiscard]] bool inside_arc(std::uint32_t arc, const Direction& x) const {
    const std::uint32_t s = map_.shalfedges[arc].source;
    const std::uint32_t t = map_.target(arc);
    if (same_direction(x, directions_[s], monitor_) || same_direction(x, directions_[t], monitor_)) return false;
    return strictly_between_on_circle(planes_, map_.shalfedges[arc].plane, directions_[s], x, directions_[t], s == t,
                                      monitor_);
  }

  void check_arcs_are_disjoint() const {
    for (std::uint32_t i = 0; i < map_.shalfedges.size(); i += 2) {
      const PlaneId plane = map_.shalfedges[i].plane;
      const Direction n = Direction::normal(planes_, plane);
      for (std::uint32_t v = 0; v < directions_.size(); ++v) {
        if (sign_of_dot(n, directions_[v], monitor_) != 0) continue;
        require(!inside_arc(i, directions_[v]), "no svertex inside an arc", {{"shalfedge", i}, {"svertex", v}});
      }
      for (std::uint32_t j = 0; j < i; j += 2) {
        if (map_.shalfedges[j].plane.row() == plane.row()) continue;
        const Direction x = Direction::cross(n, Direction::normal(planes_, map_.shalfedges[j].plane));
        for (const Direction& meeting : {x, x.negated()}) {
          // If the normals are parallel, two planes through one point would be one plane.
          require(!meeting.is_zero(), "planes of one sphere map are not parallel",
                  {{"shalfedge", i}, {"shalfedge", j}});
          require(!inside_arc(i, meeting) || !inside_arc(j, meeting), "arcs do not cross",
                  {{"shalfedge", i}, {"shalfedge", j}});
        }
      }
    }
  }

  void check_sloop_is_free() const {
    if (map_.sloops.empty()) return;
    const Direction n = Direction::normal(planes_, map_.sloops[0].plane);
    for (std::uint32_t v = 0; v < directions_.size(); ++v) {
      require(sign_of_dot(n, directions_[v], monitor_) != 0, "no svertex on a sloop", {{"svertex", v}});
    }
    for (std::uint32_t i = 0; i < map_.shalfedges.size(); i += 2) {
      const Direction x = Direction::cross(n, Direction::normal(planes_, map_.shalfedges[i].plane));
      require(!x.is_zero(), "no arc on the circle of a sloop", {{"shalfedge", i}});
      require(!inside_arc(i, x) && !inside_arc(i, x.negated()), "no arc crosses a sloop", {{"shalfedge", i}});
    }
  }

  void check_entries() const {
    std::vector<bool> arc_met(map_.shalfedges.size(), false);
    std::vector<bool> svertex_met(map_.svertices.size(), false);
    std::vector<bool> loop_met(map_.sloops.size(), false);
    std::size_t used = 0;
    for (std::uint32_t f = 0; f < map_.sfaces.size(); ++f) {
      for (std::uint32_t k = 0; k < map_.sfaces[f].entry_count; ++k, ++used) {
        const SFaceEntry& entry = map_.entries[map_.sfaces[f].entries + k];
        switch (entry.kind) {
          case SFaceEntry::Kind::kCycle:
            require(entry.index < arc_met.size() && !arc_met[entry.index], "one entry for each boundary cycle",
                    {{"sface", f}, {"entry", k}});
            for (std::uint32_t e = entry.index; !arc_met[e]; e = map_.shalfedges[e].next) {
              arc_met[e] = true;
              require(map_.shalfedges[e].sface == f, "shalfedges point to the sface they bound",
                      {{"sface", f}, {"shalfedge", e}});
            }
            break;
          case SFaceEntry::Kind::kIsolatedVertex:
            require(entry.index < svertex_met.size() && !svertex_met[entry.index] &&
                        map_.svertices[entry.index].out == kNone && map_.svertices[entry.index].sface == f,
                    "isolated svertices point to their sface", {{"sface", f}, {"entry", k}});
            svertex_met[entry.index] = true;
            break;
          case SFaceEntry::Kind::kLoop:
            require(entry.index < loop_met.size() && !loop_met[entry.index] && map_.sloops[entry.index].sface == f,
                    "sloops point to their sface", {{"sface", f}, {"entry", k}});
            loop_met[entry.index] = true;
            break;
        }
      }
    }
    require(used == map_.entries.size(), "every entry belongs to an sface", {{"entry", used}});
    for (std::size_t e = 0; e < arc_met.size(); ++e) {
      require(arc_met[e], "every boundary cycle is an entry", {{"shalfedge", e}});
    }
    for (std::size_t v = 0; v < svertex_met.size(); ++v) {
      require(svertex_met[v] || map_.svertices[v].out != kNone, "every isolated svertex is an entry", {{"svertex", v}});
    }
    for (std::size_t i = 0; i < loop_met.size(); ++i) require(loop_met[i], "every sloop is an entry", {{"sloop", i}});
  }

  // V - E + F = 1 + number of connected components on a sphere.
  void check_euler() const {
    UnionFind parts(map_.svertices.size());
    std::size_t components = map_.svertices.size() + (map_.sloops.empty() ? 0 : 1);
    for (std::uint32_t i = 0; i < map_.shalfedges.size(); i += 2) {
      if (parts.unite(map_.shalfedges[i].source, map_.target(i))) --components;
    }
    require(map_.svertices.size() + map_.sfaces.size() == 1 + components + map_.shalfedges.size() / 2,
            "V - E + F = 1 + components on the sphere", {{"components", components}, {"sfaces", map_.sfaces.size()}});
  }

  void check_simplified() const {
    const auto same_on_both_sides = [this](const auto& items, std::uint32_t i) {
      return map_.sfaces[items[i].sface].mark == items[i].mark &&
             map_.sfaces[items[i ^ 1U].sface].mark == items[i].mark;
    };
    for (std::uint32_t i = 0; i < map_.shalfedges.size(); i += 2) {
      require(!same_on_both_sides(map_.shalfedges, i), "no redundant arc", {{"shalfedge", i}});
    }
    if (!map_.sloops.empty()) require(!same_on_both_sides(map_.sloops, 0), "no redundant sloop", {});
    for (std::uint32_t v = 0; v < map_.svertices.size(); ++v) {
      const SVertex& s = map_.svertices[v];
      if (s.out == kNone) {
        require(map_.sfaces[s.sface].mark != s.mark, "no redundant isolated svertex", {{"svertex", v}});
        continue;
      }
      const std::uint32_t a = s.out;
      const std::uint32_t b = map_.next_around(a);
      const bool passes = b != a && map_.next_around(b) == a &&
                          map_.shalfedges[a].plane == map_.shalfedges[b].plane.opposite() &&
                          map_.shalfedges[a].mark == s.mark && map_.shalfedges[b].mark == s.mark;
      require(!passes, "no redundant svertex inside an arc", {{"svertex", v}});
    }
  }

  const PlaneTable& planes_;
  const SphereMapView& map_;
  Monitor monitor_;
  std::vector<Direction> directions_;
};

}  // namespace

std::string validate(const PlaneTable& planes, const SphereMapView& map, const Monitor& monitor) {
  const std::optional<Defect> defect = detail::defect_in([&] { SphereMapChecker(planes, map, monitor).run(); });
  return defect ? defect->text() : std::string();
}

}  // namespace nef

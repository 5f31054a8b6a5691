// SPDX-License-Identifier: Apache-2.0
//
// Take a connected component of the boundary (vertices joined by edges and facets) and its
// lexicographically smallest vertex v. Nothing of the component lies in direction -x of v, so that
// direction lies in an sface, whose shell bounds its volume from the inside: whatever a ray from v
// in direction -x meets first bounds the same volume, and if it meets nothing, the volume is the
// outer one. All other shells are the outer shells of volumes of their own.
// No ray is needed where the component lies in no other component's bounding box: what encloses it has it in its
// box. So the parts of an assembly that lie side by side cost nothing.
#include "nef/synthesis/volume_linking.h"

#include <algorithm>
#include <limits>

#include "nef/base/defect.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/union_find.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/location/query_structure.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef {
namespace {

class VolumeLinker {
 public:
  VolumeLinker(Complex& complex, const Monitor& monitor) : c_(complex), monitor_(monitor) {}

  void run() {
    join_sfaces();
    join_components();
    find_inner_shells();
    number_volumes();
  }

 private:
  // Half of the facets each on its own; what they have found is joined. The representatives are the same.
  void join_sfaces() {
    sfaces_.reset(c_.sface_count());
    const std::size_t count = c_.facets.size();
    if (monitor_.threads() == 1) {
      join_sfaces_of({FacetId{0}, static_cast<std::uint32_t>(count)}, sfaces_);
    } else {
      UnionFind others(c_.sface_count());
      const auto half = static_cast<std::uint32_t>(count / 2);
      parallel_calls(monitor_, {[&](const Monitor&) {
                                  join_sfaces_of({FacetId{0}, half}, sfaces_);
                                },
                                [&](const Monitor&) {
                                  join_sfaces_of({FacetId{half}, static_cast<std::uint32_t>(count) - half}, others);
                                }});
      for (std::uint32_t f = 0; f < others.size(); ++f) {
        const std::uint32_t root = others.find(f);
        if (root != f) sfaces_.unite(root, f);
      }
    }
    for (const HalfedgeId s : c_.bare_edges()) {
      const HalfedgeId t = c_.twin[s];
      const VertexId v = c_.source(s);
      const VertexId w = c_.source(t);
      sfaces_.unite((c_.vertices[v].sfaces + c_.svertex(s).sface).index(),
                    (c_.vertices[w].sfaces + c_.svertex(t).sface).index());
    }
  }

  void join_sfaces_of(IdRange<FacetId> facets, UnionFind& sets) const {
    for (const FacetId id : facets) {
      const Facet& facet = c_.facets[id];
      const std::span<const SHalfedgeId> corners = c_.corners_of(facet);
      const auto first = c_.shalfedge_sfaces(corners[0]);
      std::uint32_t above = sets.find(first[0].index());
      std::uint32_t below = sets.find(first[1].index());
      for (const SHalfedgeId corner : corners.subspan(1)) {
        const auto sfaces = c_.shalfedge_sfaces(corner);
        above = join(sets, above, sfaces[0]);
        below = join(sets, below, sfaces[1]);
      }
      for (const VertexId v : c_.isolated_vertices_of(facet)) {
        const VertexRecord& record = c_.vertices[v];
        const std::uint32_t up = record.sloops + (c_.sloops[record.sloops].plane.flipped() ? 1U : 0U);
        sets.unite(above, (record.sfaces + c_.sloops[up].sface).index());
        sets.unite(below, (record.sfaces + c_.sloops[up == record.sloops ? up + 1 : up - 1].sface).index());
      }
    }
  }

  // Unites a set, given by its representative, with that of an sface; the new representative.
  static std::uint32_t join(UnionFind& sets, std::uint32_t root, SFaceId sface) {
    const std::uint32_t other = sets.find(sface.index());
    if (other == root) return root;
    sets.unite(root, other);
    return std::min(root, other);
  }

  // Vertices that a facet or an edge joins see a common shell; so components are shells joined by vertices.
  void join_components() {
    sfaces_.flatten();
    parts_.reset(c_.sface_count());
    for (const VertexId v : c_.vertex_ids()) {
      const IdRange<SFaceId> around = c_.sfaces(v);
      const std::uint32_t first = root(around.front());
      for (const SFaceId f : around) {
        if (f != around.front()) parts_.unite(first, root(f));
      }
    }
    parts_.flatten();
  }

  // The sface that stands for all those joined with this one.
  [[nodiscard]] std::uint32_t root(SFaceId sface) const { return sfaces_.root(sface.index()); }

  // An sface that stands for the component of a vertex.
  [[nodiscard]] std::uint32_t component(VertexId vertex) const { return parts_.root(root(c_.vertices[vertex].sfaces)); }

  // Components in the order of their first vertices.
  struct Components {
    std::vector<std::uint32_t> ids;
    std::vector<VertexId> lowest;  // of each id; others: not valid

    // A vertex of a component, in the order of vertices.
    void add(const PointTable& points, std::uint32_t id, VertexId vertex, const Monitor& own) {
      VertexId& low = lowest[id];
      if (!low.valid()) ids.push_back(id);
      if (!low.valid() || compare_lexicographic(points, point_of(vertex), point_of(low), own) < 0) low = vertex;
    }
  };

  // Half of the vertices each on its own.
  [[nodiscard]] Components find_components() const {
    const auto of_range = [this](IdRange<VertexId> range, Components& found, const Monitor& own) {
      found.lowest.assign(c_.sface_count(), VertexId());
      for (const VertexId v : range) found.add(c_.points, component(v), v, own);
    };
    Components all;
    if (monitor_.threads() == 1) {
      of_range(c_.vertex_ids(), all, monitor_);
      return all;
    }
    Components others;
    const VertexId middle{c_.vertex_count() / 2};
    const VertexId end = c_.vertex_ids().end_id();
    parallel_calls(monitor_, {[&](const Monitor& own) {
                                of_range({VertexId{0}, middle}, all, own);
                              },
                              [&](const Monitor& own) {
                                of_range({middle, end}, others, own);
                              }});
    for (const std::uint32_t id : others.ids) all.add(c_.points, id, others.lowest[id], monitor_);
    return all;
  }

  void find_inner_shells() {
    const auto [components, lowest] = find_components();
    const std::vector<bool> enclosed = may_be_enclosed(components, lowest);
    std::vector<Box> rays;
    for (std::size_t i = 0; i < components.size(); ++i) {
      if (enclosed[i]) rays.push_back(ray_from(lowest[components[i]]));
    }
    const BoxTree places(rays);
    volumes_.reset(c_.sface_count());
    std::uint32_t unbounded = kNone;  // an sface of the outer volume
    const Direction minus_x = Direction::exact(-1, 0, 0);
    for (std::size_t i = 0; i < components.size(); ++i) {
      const VertexId v = lowest[components[i]];
      const SphereMapView map = c_.sphere_map(v);
      const std::uint32_t toward = sface_toward(minus_x, map);
      detail::require(toward != kNone, "nothing of a component lies before its lowest vertex", {{"vertex", v}});
      const std::uint32_t inner = root(c_.vertices[v].sfaces + toward);
      inner_.push_back(inner);
      const SFaceId seen = enclosed[i] ? sface_seen_from(v, places) : SFaceId();
      if (!seen.valid() && unbounded == kNone) unbounded = inner;
      volumes_.unite(inner, root(seen.valid() ? seen : SFaceId{unbounded}));
    }
    detail::require(unbounded != kNone, "some shell bounds the outer volume", {});
    outer_ = volumes_.find(unbounded);
  }

  // The sface of the lowest vertex of a component in direction -x; kNone if something else lies there. Where three
  // facets meet there, the map is a triangle, which lies in the half-sphere of the directions to higher vertices; -x
  // lies outside of it.
  std::uint32_t sface_toward(const Direction& minus_x, const SphereMapView& map) const {
    if (map.svertices.size() == 3 && map.shalfedges.size() == 6 && map.sfaces.size() == 2) {
      const auto direction = [&](std::uint32_t shalfedge) {
        return direction_of(c_.planes, map.svertices[map.shalfedges[shalfedge].source]);
      };
      const std::uint32_t second = map.shalfedges[0].next;
      const int turn =
          sign_of_determinant(direction(0), direction(second), direction(map.shalfedges[second].next), monitor_);
      if (turn != 0) return map.shalfedges[turn > 0 ? 1 : 0].sface;
    }
    const SphereLocation where = locate(c_.planes, map, minus_x, monitor_);
    return where.kind == SphereLocation::Kind::kSFace ? where.index : kNone;
  }

  // Which components may lie in the box of another one, as those do that it encloses: what separates a component from
  // infinity is one other component (the sphere is unicoherent).
  std::vector<bool> may_be_enclosed(const std::vector<std::uint32_t>& components, const std::vector<VertexId>& lowest) {
    std::vector<bool> result(components.size(), false);
    if (components.size() < 2) return result;
    std::vector<std::uint32_t> number(c_.sface_count(), kNone);
    for (std::uint32_t i = 0; i < components.size(); ++i) number[components[i]] = i;
    std::vector<Box> boxes(components.size());
    std::vector<Box> cores(components.size());  // what surely lies between the extreme coordinates
    for (const VertexId v : c_.vertex_ids()) {
      Box point;
      point.add_rounded(c_.points.approximate(point_of(v)));
      Box& core = cores[number[component(v)]];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        core.low[axis] = std::min(core.low[axis], point.high[axis]);
        core.high[axis] = std::max(core.high[axis], point.low[axis]);
      }
      boxes[number[component(v)]].add(point);
    }
    const BoxTree tree(boxes);
    for (std::uint32_t i = 0; i < components.size(); ++i) {
      Box point;
      point.add_rounded(c_.points.approximate(point_of(lowest[components[i]])));
      tree.for_each_overlap(point, [&](std::uint32_t other) {
        bool holds = other != i;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          holds =
              holds && boxes[other].low[axis] <= cores[i].low[axis] && cores[i].high[axis] <= boxes[other].high[axis];
        }
        result[i] = result[i] || holds;
      });
    }
    return result;
  }

  // Holds the ray from v in direction -x.
  [[nodiscard]] Box ray_from(VertexId v) const {
    Box ray;
    ray.add_rounded(c_.points.approximate(point_of(v)));
    ray.low[0] = -std::numeric_limits<double>::infinity();
    return ray;
  }

  // An sface of the volume that the ray from v in direction -x runs into, seen at its first hit; `places` are those of
  // all rays.
  SFaceId sface_seen_from(VertexId v, const BoxTree& places) {
    if (!queries_) queries_ = std::make_unique<QueryStructure>(c_, places);
    const std::optional<ComplexHit> hit = queries_->first_hit_minus_x(c_, v, monitor_);
    if (!hit) return {};
    if (hit->kind != ComplexHit::Kind::kFacet) {
      detail::require(hit->sface.valid(), "a ray comes out of a volume", {{"vertex", v}});
      return hit->sface;
    }
    const SHalfedgeId corner = c_.corners_of(hit->facet())[0];
    return c_.shalfedge_sfaces(corner)[is_below(hit->halffacet) ? 1 : 0];
  }

  void number_volumes() {
    const auto count = static_cast<std::uint32_t>(c_.sface_count());
    std::vector<ShellId> shell_of(count);
    std::vector<std::uint32_t> roots;
    for (std::uint32_t f = 0; f < count; ++f) {
      if (sfaces_.root(f) == f) roots.push_back(f);
    }
    std::vector<VolumeId> volume_number(count);
    VolumeId next = kOuterVolume;
    volume_number[outer_] = next;
    ++next;
    for (const std::uint32_t root : roots) {
      VolumeId& number = volume_number[volumes_.find(root)];
      if (number.valid()) continue;
      number = next;
      ++next;
    }
    std::vector<bool> is_inner(count, false);
    for (const std::uint32_t root : inner_) is_inner[root] = true;
    std::sort(roots.begin(), roots.end(), [&](std::uint32_t a, std::uint32_t b) {
      const VolumeId va = volume_number[volumes_.find(a)];
      const VolumeId vb = volume_number[volumes_.find(b)];
      if (va != vb) return va < vb;
      return is_inner[a] != is_inner[b] ? is_inner[b] : a < b;
    });
    c_.volumes.assign(next.index(), {});
    c_.shells.clear();
    c_.shells.reserve(roots.size());
    for (const std::uint32_t root : roots) {
      const VolumeId number = volume_number[volumes_.find(root)];
      Volume& volume = c_.volumes[number];
      if (volume.shell_count++ == 0) {
        volume.first_shell = c_.shells.end_id();
        volume.mark = c_.sface_mark(SFaceId{root});
      }
      detail::require_one_mark(volume.mark == c_.sface_mark(SFaceId{root}), "a volume has one mark", {{"sface", root}});
      shell_of[root] = c_.shells.push_back({number});
    }
    fill_shells(shell_of);
  }

  void fill_shells(const std::vector<ShellId>& shell_of) {
    constexpr std::size_t kTogether = 16384;
    c_.sface_shell.resize(c_.sface_count());
    parallel_for_ranges(c_.sface_count(), kTogether, monitor_,
                        [&](std::size_t first, std::size_t last, const Monitor&) {
                          for (const SFaceId f : IdRange(SFaceId{first}, SFaceId{last})) {
                            c_.sface_shell[f] = shell_of[root(f)];
                          }
                        });
    name_sides_of_facets(c_, monitor_);
  }

  Complex& c_;
  Monitor monitor_;
  UnionFind sfaces_;
  UnionFind parts_;    // over representatives of sfaces_: components of the boundary
  UnionFind volumes_;  // over representatives of sfaces_
  std::vector<std::uint32_t> inner_;
  std::uint32_t outer_ = 0;
  std::unique_ptr<QueryStructure> queries_;
};

}  // namespace

void link_volumes(Complex& complex, LabelId outer, const Monitor& monitor) {
  if (complex.vertex_count() == 0) {
    complex.volumes.assign(1, Volume{outer, ShellId{0}, 0});
    complex.shells.clear();
    return;
  }
  VolumeLinker(complex, monitor).run();
}

}  // namespace nef

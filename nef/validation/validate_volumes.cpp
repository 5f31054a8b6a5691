// SPDX-License-Identifier: Apache-2.0
//
// The invariants of shells and volumes: shells are the connected components of the boundaries,
// volumes own them by geometry. The owner of an inner shell is found again by an exact ray of a
// direction that meets no edge, against all facets whose boxes it may meet: slow, and independent of the synthesis.
#include <optional>
#include <vector>

#include "nef/base/union_find.h"
#include "nef/complex/shell_sfaces.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/ray_filter.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/mesh/polygon/triangulate.h"
#include "nef/sphere_map/sphere_geometry.h"
#include "nef/validation/concrete_points.h"
#include "nef/validation/validate.h"

namespace nef::detail {
namespace {

void check_partition(const Complex& c) {
  std::vector<bool> used(c.shells.size(), false);
  for (const VertexId v : c.vertex_ids()) {
    SFaceId sface = c.vertices[v].sfaces;
    for (const SFace& face : c.sphere_map(v).sfaces) {
      const ShellId s = c.sface_shell[sface];
      used[s.index()] = true;
      const VolumeId volume = c.shells[s].volume;
      require(c.volumes.contains(volume) && face.mark == c.volumes[volume].mark, "sfaces have the mark of their volume",
              {{"sface", sface}, {"shell", s}});
      ++sface;
    }
  }
  const auto unused = std::find(used.begin(), used.end(), false);
  require(unused == used.end(), "shells have sfaces", {{"shell", static_cast<std::size_t>(unused - used.begin())}});
  std::size_t shells = 0;
  for (const VolumeId i : c.volumes.ids()) {
    const Volume& volume = c.volumes[i];
    require(volume.first_shell == ShellId{shells} || volume.shell_count == 0, "shells of volumes follow each other",
            {{"volume", i}});
    require(i == kOuterVolume || volume.shell_count > 0, "a volume has a boundary", {{"volume", i}});
    for (const ShellId s : volume.shells()) {
      require(c.shells.contains(s) && c.shells[s].volume == i, "shells know their volume",
              {{"volume", i}, {"shell", s}});
    }
    shells += volume.shell_count;
  }
  require(shells == c.shells.size(), "every shell belongs to a volume", {});
}

// Components of sfaces by way of edges without facets and of halffacets.
void check_connection(const Complex& c) {
  UnionFind sfaces(c.sface_count());
  IndexedVector<HalffacetId, SFaceId> of_halffacet(2 * c.facets.size());
  const auto meet = [&](HalffacetId halffacet, SFaceId sface) {
    if (!of_halffacet[halffacet].valid()) {
      of_halffacet[halffacet] = sface;
    } else {
      sfaces.unite(of_halffacet[halffacet].index(), sface.index());
    }
  };
  for (const SHalfedgeId e : c.shalfedge_ids()) meet(c.shalfedge_facet[e], c.shalfedge_sface(e));
  for (const VertexId v : c.vertex_ids()) {
    for (std::uint32_t i = c.vertices[v].sloops; i < c.vertices[v.next()].sloops; ++i) {
      meet(c.sloop_facet[i], c.vertices[v].sfaces + c.sloops[i].sface);
    }
  }
  for (const HalfedgeId h : c.halfedge_ids()) {
    const HalfedgeId t = c.twin[h];
    require((c.svertex(h).out == kNone) == (c.svertex(t).out == kNone), "both ends of an edge have facets, or neither",
            {{"halfedge", h}});
    if (c.svertex(h).out != kNone) continue;
    sfaces.unite(c.sfaces(c.source(h))[c.svertex(h).sface].index(), c.sfaces(c.source(t))[c.svertex(t).sface].index());
  }
  IndexedVector<SFaceId, ShellId> shell_of(c.sface_count());
  IndexedVector<ShellId, SFaceId> root_of(c.shells.size());
  for (const SFaceId s : c.sface_ids()) {
    const SFaceId root{sfaces.find(s.index())};
    const ShellId shell = c.sface_shell[s];
    if (!shell_of[root].valid()) shell_of[root] = shell;
    if (!root_of[shell].valid()) root_of[shell] = root;
    require(shell_of[root] == shell, "sfaces that are connected are in one shell", {{"sface", root}, {"sface", s}});
    require(root_of[shell] == root, "a shell is connected", {{"shell", shell}, {"sface", s}});
  }
}

VertexId lowest_vertex(const Complex& c, std::span<const SFaceId> sfaces, const Monitor& monitor) {
  VertexId lowest;
  for (const SFaceId sface : sfaces) {
    const VertexId v = c.sface_vertex(sface);
    if (!lowest.valid() || compare_lexicographic(c.points, point_of(v), point_of(lowest), monitor) < 0) lowest = v;
  }
  return lowest;
}

// Seen from its lowest vertex, an inner shell has the volume on the low side, an outer one not.
bool is_outer(const Complex& c, const ShellSfaces& sfaces, ShellId s, const Monitor& monitor) {
  const VertexId v = lowest_vertex(c, sfaces.of(s), monitor);
  const SphereLocation low = locate(c.planes, c.sphere_map(v), Direction::exact(-1, 0, 0), monitor);
  return low.kind != SphereLocation::Kind::kSFace || c.sface_shell[c.vertices[v].sfaces + low.index] != s;
}

void check_outer_shells(const Complex& c, const ShellSfaces& sfaces, const Monitor& monitor) {
  for (const VolumeId i : c.volumes.ids()) {
    for (const ShellId s : c.volumes[i].shells()) {
      require(is_outer(c, sfaces, s, monitor) == (i != kOuterVolume && s == c.volumes[i].first_shell),
              "the outer shell of a volume comes first, and volume 0 has none", {{"volume", i}, {"shell", s}});
    }
  }
}

Integer3 scaled_sum(const Integer& factor, const Integer3& a, const Integer3& b) {
  return {Integer(factor * a[0] + b[0]), Integer(factor * a[1] + b[1]), Integer(factor * a[2] + b[2])};
}

// A vector on the boundary of an sface of the map, and one that leads from there into the sface.
struct Inward {
  Integer3 on;
  Integer3 inward;
};
Inward inward_of(const PlaneTable& planes, const SphereMapView& map, const SFace& sface, const Monitor& monitor) {
  if (sface.entry_count == 0) return {Integer3{1, 0, 0}, Integer3{0, 1, 0}};
  const SFaceEntry& entry = map.entries[sface.entries];
  if (entry.kind == SFaceEntry::Kind::kIsolatedVertex) {
    return {direction_of(planes, map.svertices[entry.index]).integers(), Integer3{1, 3, 7}};
  }
  const bool loop = entry.kind == SFaceEntry::Kind::kLoop;
  const Direction n =
      Direction::normal(planes, loop ? map.sloops[entry.index].plane : map.shalfedges[entry.index].plane);
  if (loop) {
    const Integer3& v = n.integers();
    const bool polar = v[0] == 0 && v[1] == 0;
    return {polar ? Integer3{1, 0, 0} : Integer3{Integer(-v[1]), v[0], 0}, v};
  }
  const Direction s = direction_of(planes, map.svertices[map.shalfedges[entry.index].source]);
  const Direction t = direction_of(planes, map.svertices[map.target(entry.index)]);
  // An arc of at least a half-turn holds the direction a quarter-turn after its source.
  const bool short_arc = sign_of_determinant(n, s, t, monitor) > 0;
  return {short_arc ? scaled_sum(1, s.integers(), t.integers()) : Direction::cross(n, s).integers(), n.integers()};
}

// The boxes of all facets, and the exact points that rays are shot at.
struct Targets {
  IndexedVector<VertexId, Rational3> points;
  BoxTree facets;
};
Targets targets_of(const Complex& c) {
  std::vector<Box> boxes(c.facets.size());
  for (const FacetId f : c.facets.ids()) {
    for (const SHalfedgeId corner : c.corners_of(f)) {
      boxes[f.index()].add_rounded(c.points.approximate(point_of(c.shalfedge_vertex(corner))));
    }
  }
  return {concrete_points(c), BoxTree(boxes)};
}

// The nearest facet that a ray meets; fails if the ray comes upon a boundary.
struct FirstFacet {
  bool degenerate = false;
  VolumeId volume = kOuterVolume;  // on the near side; the outer volume if nothing is met
};
FirstFacet shoot(const Complex& c, const Targets& targets, VertexId origin, const Integer3& along) {
  const IndexedVector<VertexId, Rational3>& points = targets.points;
  const Rational3& from = points[origin];
  Box origin_box;
  origin_box.add_rounded(c.points.approximate(point_of(origin)));
  const RayFilter filter(origin_box, Direction::exact(along[0], along[1], along[2]));
  FirstFacet result;
  std::optional<Rational> nearest;
  const auto visit = [&](std::uint32_t f) {
    const Facet& facet = c.facets[FacetId{f}];
    const Rational3& anchor = points[c.shalfedge_vertex(c.corners_of(facet)[0])];
    Rational numerator = 0;
    Rational denominator = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Integer n = c.planes.oriented_coefficient(facet.plane, i);
      numerator += n * (anchor[i] - from[i]);
      denominator += n * along[i];
    }
    if (denominator == 0) return;
    const Rational t = numerator / denominator;
    if (t <= 0 || (nearest && t >= *nearest)) return;
    const Rational3 hit{from[0] + t * along[0], from[1] + t * along[1], from[2] + t * along[2]};
    const ProjectionAxis projection = projection_axis(c.planes, facet.plane);
    int number = 0;
    for (const CycleId k : facet.cycles()) {
      const Winding winding = winding_number(cycle_points(c, points, k), hit, projection.axis);
      result.degenerate = result.degenerate || winding.on_boundary;
      number += winding.number;
    }
    if (number == 0) return;
    nearest = t;
    result.volume = denominator < 0 ? facet.volume_above : facet.volume_below;
  };
  targets.facets.for_each_if([&](const Box& box) { return !result.degenerate && filter.may_meet(box); }, visit);
  return result;
}

// The volume that holds the surroundings of a shell.
VolumeId volume_around(const Complex& c, const Targets& targets, SFaceId sface, const Monitor& monitor) {
  const VertexId v = c.sface_vertex(sface);
  const std::uint32_t local = c.sfaces(v).position(sface);
  const SphereMapView map = c.sphere_map(v);
  const Inward inward = inward_of(c.planes, map, map.sfaces[local], monitor);
  for (unsigned attempt = 1; attempt < 256; ++attempt) {
    // Ever closer to the boundary of the sface, and ever another way; sfaces may be as thin as coordinates are long.
    const Integer3 bent = scaled_sum(64 * attempt, inward.inward, Integer3{attempt, 3 * attempt * attempt, 7});
    const Integer3 along = scaled_sum(Integer(1) << (4 * attempt + attempt * attempt / 4), inward.on, bent);
    const SphereLocation place = locate(c.planes, map, Direction::exact(along[0], along[1], along[2]), monitor);
    if (place.kind != SphereLocation::Kind::kSFace || place.index != local) continue;
    const FirstFacet first = shoot(c, targets, v, along);
    if (!first.degenerate) return first.volume;
  }
  break_invariant(Defect::Kind::kStructure, "some direction leads into an sface", {{"sface", sface}});
}

void check_shell_nesting(const Complex& c, const ShellSfaces& sfaces, const Monitor& monitor) {
  const Targets targets = targets_of(c);
  for (const VolumeId i : c.volumes.ids()) {
    for (const ShellId s : c.volumes[i].shells()) {
      if (i != kOuterVolume && s == c.volumes[i].first_shell) continue;
      require(volume_around(c, targets, sfaces.of(s).front(), monitor) == i, "inner shells lie in their volume",
              {{"volume", i}, {"shell", s}});
    }
  }
}

}  // namespace

void check_volumes(const Complex& complex, const Monitor& monitor) {
  check_partition(complex);
  check_connection(complex);
  const ShellSfaces sfaces(complex);
  check_outer_shells(complex, sfaces, monitor);
  check_shell_nesting(complex, sfaces, monitor);
}

}  // namespace nef::detail

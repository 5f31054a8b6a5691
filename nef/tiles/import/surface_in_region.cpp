// SPDX-License-Identifier: Apache-2.0
//
// The faces that meet a region are made a surface, which any selection of faces is. Its facets are marked by the way
// they are turned. Cut out along the walls of the region, it divides the region into volumes; a facet beside each tells
// whether that is inside.
#include "nef/tiles/import/surface_in_region.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "nef/complex/local_pyramid.h"
#include "nef/complex/rewrite_sphere_maps.h"
#include "nef/import/mesh_faces.h"
#include "nef/sphere_map/overlay.h"
#include "nef/synthesis/complex_builder.h"
#include "nef/tiles/cuts/cutter.h"

namespace nef {
namespace {

// Marks of oriented surfaces.
constexpr LabelId kTurnedUp = 1;

class RegionFiller {
 public:
  RegionFiller(Complex&& complex, const Monitor& monitor) : c_(std::move(complex)), monitor_(monitor) {
    everything_.assign_trivial(0);
  }

  // Finds which volumes are inside; false if facets contradict each other. A region that facets divide has one beside
  // each volume; what only touches its walls does not divide it.
  bool find_sides(const std::function<bool()>& inside) {
    inside_.assign(c_.volumes.size(), kUnknown);
    inside_[kOuterVolume] = kOutside;
    bool any = false;
    for (const Facet& facet : c_.facets) {
      if (facet.mark == 0) continue;
      const LabelId above = facet.mark == kTurnedUp ? 0 : 1;
      if (!mark(facet.volume_above, above) || !mark(facet.volume_below, 1 - above)) return false;
      any = true;
    }
    if (!any) std::replace(inside_.begin(), inside_.end(), kUnknown, static_cast<LabelId>(inside() ? 1 : 0));
    return std::none_of(inside_.begin(), inside_.end(), [](LabelId x) { return x == kUnknown; });
  }

  // The closed solid.
  Complex fill() {
    for (const VolumeId v : c_.volumes.ids()) c_.volumes[v].mark = inside_[v];
    rewrite_sphere_maps(c_, [this](VertexId v, SphereMapBuffer& map) { fill(v, map); });
    c_.facets.assign_marks([this](FacetId f) { return mark_between(c_.facets[f]); });
    c_.label_count = 2;
    return has_idle_items() ? simplified() : std::move(c_);
  }

 private:
  static constexpr LabelId kUnknown = kOutside - 1;

  bool mark(VolumeId volume, LabelId wanted) {
    LabelId& known = inside_[volume];
    if (volume == kOuterVolume) return true;  // the facet lies in a wall
    if (known == kUnknown) known = wanted;
    return known == wanted;
  }

  [[nodiscard]] LabelId mark_between(const Facet& facet) const {
    if (facet.mark != 0) return 1;
    const LabelId above = inside_[facet.volume_above];
    return above != kOutside ? above : inside_[facet.volume_below];
  }

  // What is in a wall and not on the surface has the mark of the region beside it.
  void fill(VertexId v, SphereMapBuffer& map) const {
    for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) {
      map.sfaces[f].mark = inside_[c_.sface_volume(c_.vertices[v].sfaces + f)];
    }
    for (SVertex& s : map.svertices) {
      if (s.mark != 0) {
        s.mark = 1;
      } else if (s.out == kNone) {
        s.mark = map.sfaces[s.sface].mark;
      } else {
        s.mark = beside_arc(map, s.out);
      }
    }
    for (std::uint32_t e = 0; e < map.shalfedges.size(); ++e) {
      SHalfedge& arc = map.shalfedges[e];
      arc.mark = arc.mark != 0 ? LabelId{1} : beside_arc(map, e);
    }
    for (std::uint32_t l = 0; l < map.sloops.size(); ++l) {
      SLoop& loop = map.sloops[l];
      const LabelId near = map.sfaces[loop.sface].mark;
      loop.mark = loop.mark != 0 ? LabelId{1} : near != kOutside ? near : map.sfaces[map.sloops[l ^ 1U].sface].mark;
    }
    if (map.mark != 0) {
      map.mark = 1;
      return;
    }
    for (const SFace& face : map.sfaces) {
      if (face.mark != kOutside) map.mark = face.mark;
    }
  }

  static LabelId beside_arc(const SphereMapBuffer& map, std::uint32_t arc) {
    const auto left = [&map](std::uint32_t e) { return map.sfaces[map.shalfedges[e].sface].mark; };
    return left(arc) != kOutside ? left(arc) : left(arc ^ 1U);
  }

  // What divides nothing in the region, though it is needed in the whole solid: the surface may touch a wall, lie in
  // it, or turn off behind it.
  bool has_idle_items() {
    for (const VertexId v : c_.vertex_ids()) {
      const SphereMapView map = c_.sphere_map(v);
      const bool in_wall =
          std::any_of(map.sfaces.begin(), map.sfaces.end(), [](const SFace& f) { return f.mark == kOutside; });
      if (!in_wall) continue;
      const SphereMapView simple = simplified(map);
      if (simple.svertices.size() != map.svertices.size() || simple.shalfedges.size() != map.shalfedges.size() ||
          simple.sloops.size() != map.sloops.size() || !is_vertex(c_.planes, simple, monitor_)) {
        return true;
      }
    }
    return false;
  }

  // Valid until the next call.
  SphereMapView simplified(const SphereMapView& map) {
    overlay_.overlay(c_.planes, map, everything_.view(), keep_, simple_, monitor_);
    return simple_.view();
  }

  Complex simplified() {
    PlaneTable planes = c_.planes;
    ComplexBuilder builder(planes, monitor_);
    for (const VertexId v : c_.vertex_ids()) {
      builder.add(c_.points, point_of(v), simplified(c_.sphere_map(v)));
    }
    return builder.finish(kOutside);
  }

  Complex c_;
  Monitor monitor_;
  IndexedVector<VolumeId, LabelId> inside_;
  SphereOverlay overlay_;
  LabelFunction keep_{2, 1, [](LabelId x, LabelId) { return x; }};
  SphereMapBuffer everything_;
  SphereMapBuffer simple_;
};

}  // namespace

std::optional<TileRef> solid_in_region(const Mesh& faces, const Region& region, const Tiling& tiling,
                                       const Monitor& monitor, const std::function<bool()>& inside) {
  if (faces.face_count() == 0) return uniform_leaf(inside() ? 1 : 0);
  const MeshSurface surface(faces, monitor);
  Complex whole = MeshFaces(faces, surface, {.monitor = monitor}, nullptr).oriented_surface();
  Cutter cutter(whole.planes, tiling, monitor);
  Complex piece = cutter.loose(whole);
  whole = Complex();
  RegionFiller filler(cutter.linked(cutter.restricted(std::move(piece), region)), monitor);
  if (!filler.find_sides(inside)) return std::nullopt;
  return subdivided(Polyhedron(filler.fill()), tiling, monitor);
}

}  // namespace nef

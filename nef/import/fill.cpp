// SPDX-License-Identifier: Apache-2.0
//
// The arrangement of the faces tells for each facet how many faces cover it one way less those that cover it the other
// way, which is what the winding number changes by from one side of the facet to the other. So the winding numbers of
// all volumes follow from that of the outer one, 0, breadth first. Then volumes are marked by the rule, all else by the
// volumes around it, which gives the closure of the interior: what has the same volumes all around gets a mark of its
// own, which an overlay with nothing then makes that of the volumes. It looks at such items only and copies the rest
// with its links.
#include "nef/import/fill.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/complex/local_pyramid.h"
#include "nef/complex/rewrite_sphere_maps.h"
#include "nef/import/mesh_faces.h"
#include "nef/mesh/polygon/perturbed_turn.h"
#include "nef/mesh/polygon/triangulate.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"

namespace nef {
namespace {

// Marks of items with the same volumes all around: these and the mark of the volumes.
constexpr LabelId kIdle = 2;

LabelId without_idle(LabelId mark, LabelId /*of nothing*/) { return mark % kIdle; }

class WindingFiller {
 public:
  WindingFiller(const Polyhedron& faces, const Mesh& mesh, const MeshSurface& surface, const FillOptions& options)
      : c_(faces.complex()), mesh_(mesh), surface_(surface), options_(options) {}

  FilledMesh run() {
    find_windings();
    const auto [low, high] = std::minmax_element(winding_.begin(), winding_.end());
    FilledMesh result;
    result.lowest = *low;
    result.highest = *high;
    if (*low == 0 && *high == 0) throw InputError(kEnclosesNothing);
    if (options_.rule == Crossings::kRefuse) check_windings(*low, *high);
    if (options_.measure != Measure::kNot) result.volumes = volumes();
    result.set = fill();
    if (result.set.is_empty()) throw InputError(kEnclosesNothing);
    return result;
  }

 private:
  void check_windings(int low, int high) const {
    if (low < 0 && high > 0) refuse([](int w) { return w < 0; });
    if (high > 1) refuse([](int w) { return w > 1; });
    if (low < -1) refuse([](int w) { return w < -1; });
  }

  // The middle of one of the triangles that a facet can be cut into.
  [[nodiscard]] Rational3 inner_point(FacetId f, Triangulator& triangulator) const {
    const Facet& facet = c_.facets[f];
    std::vector<std::vector<std::uint32_t>> rings;
    for (const CycleId i : facet.cycles()) {
      std::vector<std::uint32_t>& ring = rings.emplace_back();
      for (const SHalfedgeId corner : c_.corners_of(i)) ring.push_back(point_of(c_.shalfedge_vertex(corner)).index());
    }
    std::vector<Triangulator::Triangle> triangles;
    const std::size_t axis = largest_component(facet.plane);
    const int up = c_.planes.coefficient(facet.plane, axis).sign();
    const bool done = triangulator.triangulate(rings, axis, up, triangles);
    NEF_ASSERT(done && !triangles.empty());
    Rational3 middle;
    for (const std::uint32_t v : triangles[0]) {
      const Rational3 corner = c_.points.rational(PointId{v});
      for (std::size_t i = 0; i < 3; ++i) middle[i] += corner[i] / 3;
    }
    return middle;
  }

  // A face that covers a facet, to name in a message. O(n).
  [[nodiscard]] std::uint32_t face_on(FacetId f) const {
    const PlaneId plane = c_.facets[f].plane;
    const std::size_t axis = largest_component(plane);
    const MeshPoints points(c_.points);
    Triangulator triangulator(points, options_.monitor);
    const Rational3 point = inner_point(f, triangulator);
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      const Rational3& a = mesh_.vertices[surface_.triangles[t][0]];
      const Rational3& b = mesh_.vertices[surface_.triangles[t][1]];
      const Rational3& c = mesh_.vertices[surface_.triangles[t][2]];
      if (!on_plane(plane, a) || !on_plane(plane, b) || !on_plane(plane, c)) continue;
      const int first = perturbed_turn(a, b, point, axis);
      if (perturbed_turn(b, c, point, axis) == first && perturbed_turn(c, a, point, axis) == first) {
        return surface_.face_of[t];
      }
    }
    throw std::logic_error("internal error, please report: a facet that no face covers");
  }

  [[nodiscard]] std::size_t largest_component(PlaneId plane) const {
    const auto& normal = c_.planes.approximate(plane);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    }
    return axis;
  }

  [[nodiscard]] bool on_plane(PlaneId plane, const Rational3& p) const {
    Rational sum = Rational(Integer(c_.planes.coefficient(plane, 3)));
    for (std::size_t i = 0; i < 3; ++i) sum += Rational(Integer(c_.planes.coefficient(plane, i))) * p[i];
    return sum == 0;
  }

  // How often the volume below a facet is wound around more than the one above.
  [[nodiscard]] int change(const Facet& facet) const {
    return options_.covering == Covering::kSigned ? net_of_mark(facet.mark) : 1;
  }

  [[nodiscard]] int beyond(int winding, int change) const {
    switch (options_.covering) {
      case Covering::kSigned:
        return winding + change;
      case Covering::kParity:
        return 1 - winding;
      case Covering::kAny:
        break;
    }
    return 1;
  }

  // Breadth first through the facets, from the outer volume.
  void find_windings() {
    struct Step {
      VolumeId to;
      int change = 0;
    };
    IndexedVector<VolumeId, std::vector<Step>> steps(c_.volumes.size());
    for (const Facet& facet : c_.facets) {
      if (facet.volume_above == facet.volume_below) continue;
      steps[facet.volume_above].push_back({facet.volume_below, change(facet)});
      steps[facet.volume_below].push_back({facet.volume_above, -change(facet)});
    }
    IndexedVector<VolumeId, bool> known(c_.volumes.size(), false);
    winding_.assign(c_.volumes.size(), 0);
    known[kOuterVolume] = true;
    std::vector<VolumeId> queue{kOuterVolume};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const auto& [to, change] : steps[queue[i]]) {
        const int winding = beyond(winding_[queue[i]], change);
        if (!known[to]) {
          known[to] = true;
          winding_[to] = winding;
          queue.push_back(to);
        } else if (winding_[to] != winding && options_.covering != Covering::kAny) {
          throw InputError("the mesh is not closed: its faces do not separate inside from outside");
        }
      }
    }
    NEF_ASSERT(queue.size() == c_.volumes.size());  // only facets separate volumes
    if (options_.inside_out) {
      for (int& winding : winding_) winding = -winding;
    }
  }

  // Names a face that bounds a volume of a winding number that must not be.
  template <typename Wrong>
  [[noreturn]] void refuse(Wrong wrong) const {
    for (const FacetId f : c_.facets.ids()) {
      const Facet& facet = c_.facets[f];
      const int above = winding_[facet.volume_above];
      const int below = winding_[facet.volume_below];
      if (wrong(above) == wrong(below)) continue;
      const std::string face = std::to_string(face_on(f));
      const int bad = wrong(above) ? above : below;
      if (bad < 0 && *std::max_element(winding_.begin(), winding_.end()) > 0) {
        throw InputError(
            "components of the mesh contradict each other: face " + face +
            " has the outside behind it, other faces have the inside behind them; turn its component over");
      }
      throw InputError("components of the mesh contradict each other: what face " + face +
                       " encloses is enclosed by others already; turn its component over if it bounds a cavity, or "
                       "unite the components");
    }
    throw std::logic_error("internal error, please report: a winding number that no facet bounds");
  }

  [[nodiscard]] std::map<int, WindingVolume> volumes() const {
    std::map<int, WindingVolume> result;
    for (const int winding : winding_) ++result[winding].parts;
    --result[0].parts;  // the outer volume
    Complex marked = c_;
    for (auto& [winding, entry] : result) {
      for (const VolumeId v : marked.volumes.ids()) {
        marked.volumes[v].mark = v != kOuterVolume && winding_[v] == winding ? 1 : 0;
      }
      if (options_.measure == Measure::kExactly) {
        entry.volume = nef::volume(marked).value();
      } else {
        entry.measured = approximate_volume(Polyhedron(Complex(marked)), options_.threads, options_.monitor);
      }
    }
    return result;
  }

  Polyhedron fill() {
    Complex filled = c_;
    idle_ = false;
    for (const VolumeId v : filled.volumes.ids()) {
      filled.volumes[v].mark = v != kOuterVolume && is_taken(options_.rule, winding_[v]) ? 1 : 0;
    }
    rewrite_sphere_maps(filled, [this, &filled](VertexId v, SphereMapBuffer& map) {
      for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) {
        map.sfaces[f].mark = filled.volumes[filled.sface_volume(filled.vertices[v].sfaces + f)].mark;
      }
      mark_between(map);
    });
    filled.facets.assign_marks([&filled](FacetId f) {
      const FacetSides sides = filled.facets.sides_of(f);
      return between(filled.volumes[sides.volume_above].mark, filled.volumes[sides.volume_below].mark);
    });
    filled.label_count = idle_ ? 2 * kIdle : 2;
    Polyhedron marked(std::move(filled));
    if (!idle_) return marked;
    return overlay(marked, Polyhedron(), without_idle, options_.threads, options_.monitor);
  }

  static LabelId between(LabelId a, LabelId b) { return a == b ? kIdle + a : 1; }

  // Gives all that lies between the sfaces its mark.
  void mark_between(SphereMapBuffer& map) {
    for (std::uint32_t e = 0; e < map.shalfedges.size(); e += 2) {
      const LabelId mark =
          between(map.sfaces[map.shalfedges[e].sface].mark, map.sfaces[map.shalfedges[e + 1].sface].mark);
      map.shalfedges[e].mark = map.shalfedges[e + 1].mark = mark;
      idle_ = idle_ || mark >= kIdle;
    }
    for (std::uint32_t l = 0; l < map.sloops.size(); l += 2) {
      map.sloops[l].mark = map.sloops[l + 1].mark =
          between(map.sfaces[map.sloops[l].sface].mark, map.sfaces[map.sloops[l + 1].sface].mark);
    }
    for (SVertex& node : map.svertices) {
      node.mark = mark_of_node(map, node);
      idle_ = idle_ || node.mark >= kIdle;
    }
    map.mark = map.sfaces[0].mark;
    for (const SFace& face : map.sfaces) map.mark = map.mark == face.mark ? map.mark : LabelId{kIdle};
    map.mark = map.mark == kIdle ? 1 : kIdle + map.mark;
    if (map.mark == 1 && !is_vertex(c_.planes, map.view(), options_.monitor)) map.mark = kIdle + 1;
    idle_ = idle_ || map.mark >= kIdle;
  }

  // An edge between two facets in one plane is idle like one that has the same volume all around.
  static LabelId mark_of_node(const SphereMapBuffer& map, const SVertex& node) {
    if (node.out == kNone) return kIdle + map.sfaces[node.sface].mark;
    const SphereMapView view = map.view();
    const LabelId first = map.sfaces[map.shalfedges[node.out].sface].mark;
    bool one_mark = true;
    bool one_plane = true;
    std::uint32_t arcs = 0;
    std::uint32_t e = node.out;
    do {
      ++arcs;
      one_mark = one_mark && map.sfaces[map.shalfedges[e].sface].mark == first;
      one_plane = one_plane && map.shalfedges[e].plane.row() == map.shalfedges[node.out].plane.row();
      e = view.next_around(e);
    } while (e != node.out);
    if (one_mark) return kIdle + first;
    return arcs == 2 && one_plane ? kIdle + 1 : 1;
  }

  const Complex& c_;
  const Mesh& mesh_;
  const MeshSurface& surface_;
  FillOptions options_;
  IndexedVector<VolumeId, int> winding_;
  bool idle_ = false;  // there is something with the same on all sides
};

}  // namespace

FilledMesh fill_by_winding(const Polyhedron& faces, const Mesh& mesh, const MeshSurface& surface,
                           const FillOptions& options) {
  return WindingFiller(faces, mesh, surface, options).run();
}

}  // namespace nef

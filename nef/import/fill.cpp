// SPDX-License-Identifier: Apache-2.0
//
// The faces of a mesh whose edges balance are a cycle, so the number of faces that cover a point of a plane (with
// signs) changes only along edges at which faces of other planes end. These are edges of the union of the faces. So the
// number is the same all over a facet, and one point of it tells.
#include "nef/import/fill.h"

#include <algorithm>
#include <cmath>

#include "nef/base/error.h"
#include "nef/complex/rewrite_sphere_maps.h"
#include "nef/geometry/box_tree.h"
#include "nef/import/mesh_faces.h"
#include "nef/mesh/polygon/perturbed_turn.h"
#include "nef/mesh/polygon/triangulate.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

class WindingFiller {
 public:
  WindingFiller(const Polyhedron& faces, const Mesh& mesh, const MeshSurface& surface, const Monitor& monitor)
      : c_(faces.complex()), mesh_(mesh), surface_(surface), monitor_(monitor) {}

  Polyhedron run(Messages* messages) {
    if (c_.facet_count() == 0) throw InputError(kEnclosesNothing);
    count_coverings();
    find_windings();
    const auto [low, high] = std::minmax_element(winding_.begin(), winding_.end());
    if (*low < 0 && *high > 0) refuse([](int w) { return w < 0; });
    if (*high > 1) refuse([](int w) { return w > 1; });
    if (*low < -1) refuse([](int w) { return w < -1; });
    if (*low == 0 && *high == 0) throw InputError(kEnclosesNothing);
    if (*low < 0 && messages != nullptr) {
      messages->push_back(kTurnedOver);
    }
    return fill();
  }

 private:
  void count_coverings() {
    std::vector<Box> boxes;
    boxes.reserve(surface_.triangles.size());
    for (const auto& t : surface_.triangles) {
      Box& box = boxes.emplace_back();
      for (const std::uint32_t v : t) box.add_rounded(rounded(mesh_.vertices[v]));
    }
    const BoxTree tree(boxes);
    const MeshPoints points(c_.points);
    Triangulator triangulator(points, monitor_);
    coverings_.resize(c_.facet_count());
    for (const FacetId f : c_.facets.ids()) count_coverings(tree, f, inner_point(f, triangulator));
  }

  static std::array<double, 3> rounded(const Rational3& p) {
    return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
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

  void count_coverings(const BoxTree& tree, FacetId f, const Rational3& point) {
    const PlaneId plane = c_.facets[f].plane;
    const std::size_t axis = largest_component(plane);
    const int up = c_.planes.coefficient(plane, axis).sign();
    Box query;
    query.add_rounded(rounded(point));
    tree.for_each_overlap(query, [&](std::uint32_t t) {
      const Rational3& a = mesh_.vertices[surface_.triangles[t][0]];
      const Rational3& b = mesh_.vertices[surface_.triangles[t][1]];
      const Rational3& c = mesh_.vertices[surface_.triangles[t][2]];
      if (!on_plane(plane, a) || !on_plane(plane, b) || !on_plane(plane, c)) return;
      const int first = perturbed_turn(a, b, point, axis);
      if (perturbed_turn(b, c, point, axis) != first || perturbed_turn(c, a, point, axis) != first) return;
      coverings_[f].net += first * up;
      coverings_[f].face = surface_.face_of[t];
    });
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

  // Breadth first through the facets, from the outer volume.
  void find_windings() {
    struct Step {
      VolumeId to;
      int change = 0;
    };
    IndexedVector<VolumeId, std::vector<Step>> beyond(c_.volumes.size());
    for (const FacetId f : c_.facets.ids()) {
      const Facet& facet = c_.facets[f];
      beyond[facet.volume_above].push_back({facet.volume_below, coverings_[f].net});
      beyond[facet.volume_below].push_back({facet.volume_above, -coverings_[f].net});
    }
    IndexedVector<VolumeId, bool> known(c_.volumes.size(), false);
    winding_.assign(c_.volumes.size(), 0);
    known[kOuterVolume] = true;
    std::vector<VolumeId> queue{kOuterVolume};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (const auto& [to, change] : beyond[queue[i]]) {
        const int winding = winding_[queue[i]] + change;
        if (!known[to]) {
          known[to] = true;
          winding_[to] = winding;
          queue.push_back(to);
        } else if (winding_[to] != winding) {
          throw InputError("the mesh is not closed: its faces do not separate inside from outside");
        }
      }
    }
    NEF_ASSERT(queue.size() == c_.volumes.size());  // only facets separate volumes
  }

  // Names a face that bounds a volume of a winding number that must not be.
  template <typename Wrong>
  [[noreturn]] void refuse(Wrong wrong) const {
    for (const FacetId f : c_.facets.ids()) {
      const Facet& facet = c_.facets[f];
      const int above = winding_[facet.volume_above];
      const int below = winding_[facet.volume_below];
      if (wrong(above) == wrong(below)) continue;
      const std::string face = std::to_string(coverings_[f].face);
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

  Polyhedron fill() {
    Complex filled = c_;
    bool idle = false;  // facets with the same on both sides, or edges without facets
    for (const VolumeId v : filled.volumes.ids()) filled.volumes[v].mark = winding_[v] != 0 ? 1 : 0;
    rewrite_sphere_maps(filled, [&filled, &idle](VertexId v, SphereMapBuffer& map) {
      for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) {
        map.sfaces[f].mark = filled.volumes[filled.sface_volume(filled.vertices[v].sfaces + f)].mark;
      }
      for (const SVertex& end : map.svertices) idle = idle || end.out == kNone;
    });
    for (const Facet& facet : filled.facets) {
      idle = idle || filled.volumes[facet.volume_above].mark == filled.volumes[facet.volume_below].mark;
    }
    // Where every facet has different marks on its sides, everything that was needed still is.
    Polyhedron result(std::move(filled));
    return idle ? regularize(result, monitor_) : result;
  }

  struct Covering {
    int net = 0;  // faces that look up less those that look down
    std::uint32_t face = 0;
  };

  const Complex& c_;
  const Mesh& mesh_;
  const MeshSurface& surface_;
  Monitor monitor_;
  IndexedVector<FacetId, Covering> coverings_;
  IndexedVector<VolumeId, int> winding_;
};

}  // namespace

Polyhedron fill_by_winding(const Polyhedron& faces, const Mesh& mesh, const MeshSurface& surface, Messages* messages,
                           const Monitor& monitor) {
  return WindingFiller(faces, mesh, surface, monitor).run(messages);
}

}  // namespace nef

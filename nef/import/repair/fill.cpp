// SPDX-License-Identifier: Apache-2.0
//
// The arrangement of the faces tells for each facet how many faces cover it one way less those that cover it the other
// way, which is what the winding number changes by from one side of the facet to the other. So the winding numbers of
// all volumes follow from that of the outer one, 0, breadth first. Then volumes are marked by the rule, all else by the
// volumes around it, which gives the closure of the interior: what has the same volumes all around gets a mark of its
// own, which an overlay with nothing then makes that of the volumes. It looks at such items only and copies the rest
// with its links.
#include "nef/import/repair/fill.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "nef/base/error.h"
#include "nef/complex/local_pyramid.h"
#include "nef/complex/patterns/pattern_interner.h"
#include "nef/geometry/vectors.h"
#include "nef/import/checked_surface.h"
#include "nef/import/generalized_winding.h"
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

// How often the volume below a facet is wound around more than the one above.
int change_below(const Facet& facet, Covering covering) {
  return covering == Covering::kSigned ? net_of_mark(facet.mark) : 1;
}

int winding_beyond(int winding, int change, Covering covering) {
  switch (covering) {
    case Covering::kSigned:
      return winding + change;
    case Covering::kParity:
      return 1 - winding;
    case Covering::kAny:
      break;
  }
  return 1;
}

class WindingFiller {
 public:
  WindingFiller(Polyhedron faces, const Mesh& mesh, const FillOptions& options)
      : faces_(std::move(faces)), mesh_(mesh), options_(options) {}

  FilledMesh run() {
    if (options_.rule == Crossings::kGuess) {
      guess_windings();
    } else {
      find_windings();
    }
    const auto [low, high] = std::minmax_element(winding_.begin(), winding_.end());
    FilledMesh result;
    result.lowest = *low;
    result.highest = *high;
    if (*low == 0 && *high == 0) refuse_as_empty();
    if (options_.rule == Crossings::kRefuse) check_windings(*low, *high);
    Complex filled = std::move(faces_).take_complex();  // as large as what is made of it
    if (options_.measure != Measure::kNot) result.volumes = volumes(filled);
    result.set = fill(std::move(filled));
    if (result.set.is_empty()) refuse_as_empty();
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
    const Facet& facet = c().facets[f];
    std::vector<std::vector<std::uint32_t>> rings;
    for (const CycleId i : facet.cycles()) {
      std::vector<std::uint32_t>& ring = rings.emplace_back();
      for (const SHalfedgeId corner : c().corners_of(i)) ring.push_back(point_of(c().shalfedge_vertex(corner)).index());
    }
    std::vector<Triangulator::Triangle> triangles;
    const std::size_t axis = largest_component(facet.plane);
    const int up = c().planes.coefficient(facet.plane, axis).sign();
    const bool done = triangulator.triangulate(rings, axis, up, triangles);
    NEF_ASSERT(done && !triangles.empty());
    std::array<Rational3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = c().points.rational(PointId{triangles[0][i]});
    return mean_of<Rational>(corners);
  }

  // A face that covers a facet, to name in a message. O(n).
  [[nodiscard]] std::uint32_t face_on(FacetId f) const {
    const PlaneId plane = c().facets[f].plane;
    const std::size_t axis = largest_component(plane);
    const MeshPoints points(c().points);
    Triangulator triangulator(points, options_.monitor);
    const Rational3 point = inner_point(f, triangulator);
    const MeshSurface surface(mesh_, options_.monitor);
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
      const Rational3& a = mesh_.vertices[surface.triangles[t][0]];
      const Rational3& b = mesh_.vertices[surface.triangles[t][1]];
      const Rational3& c = mesh_.vertices[surface.triangles[t][2]];
      if (!on_plane(plane, a) || !on_plane(plane, b) || !on_plane(plane, c)) continue;
      const int first = perturbed_turn(a, b, point, axis);
      if (perturbed_turn(b, c, point, axis) == first && perturbed_turn(c, a, point, axis) == first) {
        return surface.face_of[t];
      }
    }
    throw std::logic_error("internal error, please report: a facet that no face covers");
  }

  [[nodiscard]] std::size_t largest_component(PlaneId plane) const {
    const auto& normal = c().planes.approximate(plane);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i) {
      if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    }
    return axis;
  }

  [[nodiscard]] bool on_plane(PlaneId plane, const Rational3& p) const {
    Rational sum = Rational(Integer(c().planes.coefficient(plane, 3)));
    for (std::size_t i = 0; i < 3; ++i) sum += Rational(Integer(c().planes.coefficient(plane, i))) * p[i];
    return sum == 0;
  }

  [[nodiscard]] const Complex& c() const { return faces_.complex(); }

  void find_windings() {
    std::optional<IndexedVector<VolumeId, int>> found = winding_numbers(c(), options_.covering);
    if (!found) throw InputError("the mesh is not closed: its faces do not separate inside from outside");
    winding_ = *std::move(found);
    if (options_.inside_out) {
      for (int& winding : winding_) winding = -winding;
    }
  }

  // By the mean of some points inside of each volume, each in the middle between two facets.
  void guess_windings() {
    constexpr int kSamples = 4;
    const GeneralizedWinding faces(mesh_, MeshSurface(mesh_, options_.monitor).triangles);
    const MeshPoints points(c().points);
    Triangulator triangulator(points, options_.monitor);
    IndexedVector<VolumeId, int> count(c().volumes.size(), 0);
    IndexedVector<VolumeId, double> sum(c().volumes.size(), 0);
    for (const FacetId f : c().facets.ids()) {
      const Facet& facet = c().facets[f];
      for (const auto& [volume, side] : {std::pair(facet.volume_above, 1), std::pair(facet.volume_below, -1)}) {
        if (volume == kOuterVolume || count[volume] == kSamples) continue;
        const Rational3 from = inner_point(f, triangulator);
        Rational3 direction;
        for (std::size_t i = 0; i < 3; ++i) {
          direction[i] = Rational(Integer(c().planes.coefficient(facet.plane, i))) * side;
        }
        const std::optional<RayHit> hit = shoot_ray(faces_, from, direction, {}, options_.monitor);
        NEF_ASSERT(hit);  // the volume is bounded
        sum[volume] += faces.around(mean_of<Rational>(std::array{from, hit->point}));
        ++count[volume];
      }
    }
    winding_.assign(c().volumes.size(), 0);
    const double sign = options_.inside_out ? -1 : 1;
    for (const VolumeId v : c().volumes.ids()) winding_[v] = count[v] > 0 && 2 * sign * sum[v] >= count[v] ? 1 : 0;
  }

  [[noreturn]] static void refuse_as_empty() {
    throw RefusedMesh(kEnclosesNothing, "; --as-surface (surface=True in Python) reads them as a surface");
  }

  // Names a face that bounds a volume of a winding number that must not be.
  template <typename Wrong>
  [[noreturn]] void refuse(Wrong wrong) const {
    for (const FacetId f : c().facets.ids()) {
      const Facet& facet = c().facets[f];
      const int above = winding_[facet.volume_above];
      const int below = winding_[facet.volume_below];
      if (wrong(above) == wrong(below)) continue;
      const std::string face = std::to_string(face_on(f));
      const int bad = wrong(above) ? above : below;
      if (bad < 0 && *std::max_element(winding_.begin(), winding_.end()) > 0) {
        throw InputError("components of the mesh contradict each other: face " + face +
                         " has the outside behind it, other faces have the inside behind them; flip its component");
      }
      throw InputError(
          "components of the mesh contradict each other: what face " + face +
          " encloses is enclosed by others already; flip its component if it bounds a cavity, or unite the components");
    }
    throw std::logic_error("internal error, please report: a winding number that no facet bounds");
  }

  // The marks of the volumes are lost.
  [[nodiscard]] std::map<int, WindingVolume> volumes(Complex& marked) const {
    std::map<int, WindingVolume> result;
    for (const int winding : winding_) ++result[winding].parts;
    --result[0].parts;  // the outer volume
    for (auto& [winding, entry] : result) {
      for (const VolumeId v : marked.volumes.ids()) {
        marked.volumes[v].mark = v != kOuterVolume && winding_[v] == winding ? 1 : 0;
      }
      if (options_.measure == Measure::kExactly) {
        entry.volume = nef::volume(marked).value();
      } else {
        entry.measured = approximate_volume(marked, options_.monitor);
      }
    }
    return result;
  }

  Polyhedron fill(Complex&& filled) {
    idle_ = false;
    for (const VolumeId v : filled.volumes.ids()) {
      filled.volumes[v].mark = v != kOuterVolume && is_taken(options_.rule, winding_[v]) ? 1 : 0;
    }
    mark_sphere_maps(filled);
    filled.facets.assign_marks([&filled](FacetId f) {
      const FacetSides sides = filled.facets.sides_of(f);
      return between(filled.volumes[sides.volume_above].mark, filled.volumes[sides.volume_below].mark);
    });
    filled.label_count = idle_ ? 2 * kIdle : 2;
    Polyhedron marked(std::move(filled));
    if (!idle_) return marked;
    return overlay(marked, Polyhedron(), without_idle, options_.monitor);
  }

  // What the marks of a sphere map depend on: its pattern, the marks of its sfaces, and which of its edges lie between
  // two facets in one plane.
  struct MapKey {
    PatternId pattern;
    std::uint32_t sfaces = 0;
    std::uint32_t flat_edges = 0;
    bool operator==(const MapKey&) const = default;
  };

  // What the patterns of a complex become, by what that depends on.
  class MarkedPatterns {
   public:
    explicit MarkedPatterns(const PatternTable& patterns) : last_(patterns.size(), kNone) {}

    // Not valid if it is not known.
    [[nodiscard]] PatternId find(const MapKey& key) const {
      std::uint32_t i = last_[key.pattern.index()];
      while (i != kNone && !(entries_[i].key == key)) i = entries_[i].before;
      return i == kNone ? PatternId() : entries_[i].marked;
    }

    void add(const MapKey& key, PatternId marked) {
      std::uint32_t& last = last_[key.pattern.index()];
      entries_.push_back({key, marked, last});
      last = static_cast<std::uint32_t>(entries_.size() - 1);
    }

   private:
    struct Entry {
      MapKey key;
      PatternId marked;
      std::uint32_t before;  // entry of the same pattern
    };
    std::vector<std::uint32_t> last_;  // entry of each pattern
    std::vector<Entry> entries_;
  };

  // What the key of a vertex needs to know of its pattern.
  struct PatternKind {
    bool is_known = false;
    bool has_key = false;
    std::uint32_t flat_edges = 0;  // those that may be flat: where all marks are one, they would not be there
  };

  static PatternKind kind_of(const SphereMapView& map) {
    constexpr std::size_t kBits = 32;
    const std::size_t nodes = map.svertices.size();
    PatternKind kind{true, nodes >= 3 && nodes <= kBits && map.sfaces.size() <= kBits};
    if (!kind.has_key) return kind;
    for (std::uint32_t n = 0; n < nodes; ++n) {
      const std::uint32_t e = map.svertices[n].out;
      if (e == kNone) continue;
      const std::uint32_t other = map.next_around(e);
      if (other == e || map.next_around(other) != e) continue;
      const LabelId mark = map.svertices[n].mark;
      if (map.shalfedges[e].mark != mark || map.shalfedges[other].mark != mark) kind.flat_edges |= 1U << n;
    }
    return kind;
  }

  // Nothing if there may be no vertex, which planes decide, or if there are too many items.
  static std::optional<MapKey> key_of(const Complex& c, VertexId v, PatternKind& kind) {
    if (c.vertices[v].sloops != c.vertices[v.next()].sloops) return std::nullopt;
    if (!kind.is_known) kind = kind_of(c.sphere_map(v));
    if (!kind.has_key) return std::nullopt;
    MapKey key{c.vertices.pattern(v)};
    for (std::uint32_t bit = 0; const SFaceId f : c.sfaces(v)) {
      key.sfaces |= static_cast<std::uint32_t>(c.volumes[c.sface_volume(f)].mark) << bit++;
    }
    if (kind.flat_edges == 0) return key;
    const SphereMapView map = c.sphere_map(v);
    for (std::uint32_t n = 0; n < map.svertices.size(); ++n) {
      if ((kind.flat_edges >> n & 1U) == 0) continue;
      const std::uint32_t e = map.svertices[n].out;
      const std::uint32_t other = map.next_around(e);
      if (map.shalfedges[e].plane.row() == map.shalfedges[other].plane.row()) key.flat_edges |= 1U << n;
    }
    return key;
  }

  // Gives the items at vertices their marks. Planes stay, and few sphere maps differ in what marks depend on; so of
  // each kind one is looked at.
  void mark_sphere_maps(Complex& c) {
    PatternTable patterns;
    PatternInterner interner;
    MarkedPatterns known(c.patterns);
    std::vector<PatternId> pattern_of(c.vertex_count());
    SphereMapBuffer map;
    std::vector<PatternKind> kinds(c.patterns.size());
    for (const VertexId v : c.vertex_ids()) {
      const std::optional<MapKey> key = key_of(c, v, kinds[c.vertices.pattern(v).index()]);
      PatternId& pattern = pattern_of[v.index()];
      if (key) {
        pattern = known.find(*key);
        if (pattern.valid()) continue;
      }
      map.assign(c.sphere_map(v));
      for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) {
        map.sfaces[f].mark = c.volumes[c.sface_volume(c.vertices.sfaces(v) + f)].mark;
      }
      mark_between(c.planes, map);
      pattern = marked_pattern(c.patterns.view(c.vertices.pattern(v)), map, patterns, interner);
      std::copy(map.sloops.begin(), map.sloops.end(), c.sloops.begin() + c.vertices[v].sloops);
      if (key) known.add(*key, pattern);
    }
    for (const VertexId v : c.vertex_ids()) c.vertices.set_pattern(v, pattern_of[v.index()]);
    c.patterns = std::move(patterns);
  }

  // A pattern with the marks of a map of this pattern. Its planes are names, so that those that happen to be equal at
  // one vertex keep their names apart.
  static PatternId marked_pattern(const SphereMapView& names, const SphereMapBuffer& map, PatternTable& table,
                                  PatternInterner& interner) {
    SphereMapBuffer marked;
    marked.assign(names);
    marked.mark = map.mark;
    for (std::size_t i = 0; i < map.svertices.size(); ++i) marked.svertices[i].mark = map.svertices[i].mark;
    for (std::size_t i = 0; i < map.shalfedges.size(); ++i) marked.shalfedges[i].mark = map.shalfedges[i].mark;
    for (std::size_t i = 0; i < map.sfaces.size(); ++i) marked.sfaces[i].mark = map.sfaces[i].mark;
    std::vector<PlaneId> planes;
    std::vector<PlaneId> others;
    return interner.intern(table, marked.view(), planes, others);
  }

  static LabelId between(LabelId a, LabelId b) { return a == b ? kIdle + a : 1; }

  // Gives all that lies between the sfaces its mark.
  void mark_between(const PlaneTable& planes, SphereMapBuffer& map) {
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
    if (map.mark == 1 && !is_vertex(planes, map.view(), options_.monitor)) map.mark = kIdle + 1;
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

  Polyhedron faces_;  // until they are filled
  const Mesh& mesh_;
  FillOptions options_;
  IndexedVector<VolumeId, int> winding_;
  bool idle_ = false;  // there is something with the same on all sides
};

}  // namespace

std::optional<IndexedVector<VolumeId, int>> winding_numbers(const Complex& faces, Covering covering) {
  struct Step {
    VolumeId to;
    int change = 0;
  };
  IndexedVector<VolumeId, std::vector<Step>> steps(faces.volumes.size());
  for (const Facet& facet : faces.facets) {
    if (facet.volume_above == facet.volume_below) continue;
    const int change = change_below(facet, covering);
    steps[facet.volume_above].push_back({facet.volume_below, change});
    steps[facet.volume_below].push_back({facet.volume_above, -change});
  }
  IndexedVector<VolumeId, bool> known(faces.volumes.size(), false);
  IndexedVector<VolumeId, int> result(faces.volumes.size(), 0);
  known[kOuterVolume] = true;
  std::vector<VolumeId> queue{kOuterVolume};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const auto& [to, change] : steps[queue[i]]) {
      const int winding = winding_beyond(result[queue[i]], change, covering);
      if (!known[to]) {
        known[to] = true;
        result[to] = winding;
        queue.push_back(to);
      } else if (result[to] != winding && covering != Covering::kAny) {
        return std::nullopt;
      }
    }
  }
  NEF_ASSERT(queue.size() == faces.volumes.size());  // only facets separate volumes
  return result;
}

FilledMesh fill_by_winding(Polyhedron faces, const Mesh& mesh, const FillOptions& options) {
  return WindingFiller(std::move(faces), mesh, options).run();
}

}  // namespace nef

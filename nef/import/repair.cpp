// SPDX-License-Identifier: Apache-2.0
//
// A sequence of steps on rings of vertices, each of which keeps what the steps before have done: merge equal vertices,
// drop copies, drop faces without area, make corners where a vertex of the border lies in an open side, turn faces to
// fit their neighbours (breadth first; the larger part of a component keeps its direction), put lids on holes, turn
// components by how many others contain them. The result is imported once to say whether it bounds a solid, by the rule
// for crossings if there is one. No vertex is moved, and none is made but by that rule.
#include "nef/import/repair.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <variant>

#include "nef/base/error.h"
#include "nef/base/union_find.h"
#include "nef/import/doubled_faces.h"
#include "nef/import/lids.h"
#include "nef/import/try_from_mesh.h"
#include "nef/import/winding_report.h"
#include "nef/mesh/edge_order.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/surface/surface_contacts.h"
#include "nef/mesh/vertex_merger.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

using Ring = std::vector<std::uint32_t>;

std::string counted(std::size_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

Mesh mesh_of(const std::vector<Rational3>& vertices, const std::vector<Ring>& rings) {
  Mesh mesh;
  std::unordered_map<std::uint32_t, std::uint32_t> number;
  for (Ring ring : rings) {
    for (std::uint32_t& v : ring) {
      const auto [at, is_new] = number.emplace(v, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back(vertices[v]);
      v = at->second;
    }
    mesh.push_face(ring);
  }
  return mesh;
}

std::string refusal(const Mesh& mesh, const Monitor& monitor) {
  const std::variant<Polyhedron, MeshRefusal> made = try_from_mesh(mesh, {.monitor = monitor});
  const auto* refused = std::get_if<MeshRefusal>(&made);
  return refused == nullptr ? "" : refused->text;
}

class Repairer {
 public:
  Repairer(const Mesh& mesh, const RepairOptions& options, const Monitor& monitor)
      : vertices_(mesh.vertices), options_(options), monitor_(monitor) {
    const std::vector<std::uint32_t> place = merge_equal(mesh.vertices);
    std::size_t merged = 0;
    for (std::uint32_t v = 0; v < place.size(); ++v) merged += place[v] != v ? 1 : 0;
    note(merged, "vertex", "vertices", "at the place of another united with it");
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      Ring& ring = rings_.emplace_back();
      for (const std::uint32_t v : mesh.face(f)) {
        if (v >= place.size()) throw InputError("face " + std::to_string(f) + " names a vertex that does not exist");
        if (ring.empty() || ring.back() != place[v]) ring.push_back(place[v]);
      }
      while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    }
  }

  RepairedMesh run() {
    drop_duplicates();
    drop_faces_without_area();
    split_sides();
    turn_to_neighbours();
    RepairedMesh result;
    close_holes(result);
    turn_components();
    result.mesh = mesh_of(vertices_, rings_);
    result.done = std::move(done_);
    if (rings_.empty()) {
      result.problem = "no face is left of the mesh";
    } else if (options_.crossings == Crossings::kRefuse) {
      result.problem = refusal(result.mesh, monitor_);
    } else {
      resolve(result);
    }
    return result;
  }

 private:
  void resolve(RepairedMesh& result) const {
    const MeshOptions options{.crossings = options_.crossings, .threads = options_.threads, .monitor = monitor_};
    try {
      ResolvedMesh resolved = resolve_mesh(result.mesh, options, nullptr, Measure::kDoubles);
      if (resolved.crossing_pairs == 0 && is_plain(resolved)) return;
      for (std::string& line : lines_about(resolved, options_.crossings)) result.done.push_back(std::move(line));
      result.resolved = std::move(resolved);
    } catch (const InputError& error) {
      result.problem = error.what();
    }
  }

  // Whether everything is enclosed once or not at all.
  static bool is_plain(const ResolvedMesh& resolved) {
    return std::all_of(resolved.volumes.begin(), resolved.volumes.end(),
                       [](const auto& entry) { return entry.first == 0 || entry.first == 1; });
  }

  void note(std::size_t count, const char* one, const char* many, const char* what) {
    if (count > 0) done_.push_back(counted(count, one, many) + " " + what);
  }

  void drop_duplicates() {
    const std::size_t before = rings_.size();
    rings_ = without_copies(std::move(rings_));
    note(before - rings_.size(), "face", "faces", "with the corners of another dropped");
  }

  void drop_faces_without_area() {
    const Mesh mesh = mesh_of(vertices_, rings_);
    const MeshSurface surface(mesh, monitor_);
    std::vector<Ring> kept;
    for (std::size_t f = 0; f < rings_.size(); ++f) {
      const FaceDefect defect = surface.defects[f];
      if (defect != FaceDefect::kNoArea && defect != FaceDefect::kTooFewCorners) kept.push_back(std::move(rings_[f]));
    }
    note(rings_.size() - kept.size(), "face", "faces", "without area dropped");
    rings_ = std::move(kept);
  }

  // Sides that faces use an odd number of times, as pairs of places.
  [[nodiscard]] std::set<std::array<std::uint32_t, 2>> open_sides() const {
    std::map<std::array<std::uint32_t, 2>, int> uses;
    for (const Ring& ring : rings_) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const auto [u, v] = std::minmax(ring[i], ring[(i + 1) % ring.size()]);
        ++uses[{u, v}];
      }
    }
    std::set<std::array<std::uint32_t, 2>> open;
    for (const auto& [side, count] : uses) {
      if (count % 2 == 1) open.insert(side);
    }
    return open;
  }

  // Vertices of the border that lie in an open side become corners there, so that T-junctions close.
  void split_sides() {
    const std::set<std::array<std::uint32_t, 2>> open = open_sides();
    if (open.empty()) return;
    const MeshPoints points(vertices_);
    std::vector<std::uint32_t> border;
    for (const auto& [u, v] : open) border.insert(border.end(), {u, v});
    std::sort(border.begin(), border.end());
    border.erase(std::unique(border.begin(), border.end()), border.end());
    std::vector<Box> boxes(border.size());
    for (std::size_t i = 0; i < border.size(); ++i) points.extend(boxes[i], border[i]);
    const BoxTree tree(boxes);
    std::size_t split = 0;
    for (Ring& ring : rings_) {
      Ring longer;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t u = ring[i];
        const std::uint32_t v = ring[(i + 1) % ring.size()];
        longer.push_back(u);
        if (open.count({std::min(u, v), std::max(u, v)}) == 0) continue;
        Ring inside = vertices_between(points, tree, border, u, v);
        split += inside.size();
        longer.insert(longer.end(), inside.begin(), inside.end());
      }
      ring = std::move(longer);
    }
    note(split, "vertex", "vertices", "in the side of a face made a corner of it");
  }

  [[nodiscard]] Ring vertices_between(const MeshPoints& points, const BoxTree& tree,
                                      const std::vector<std::uint32_t>& border, std::uint32_t u,
                                      std::uint32_t v) const {
    Box box;
    points.extend(box, u);
    points.extend(box, v);
    Ring inside;
    const bool up = points.compare(u, v) < 0;
    tree.for_each_overlap(box, [&](std::uint32_t i) {
      const std::uint32_t p = border[i];
      if (p == u || p == v || !points.collinear(u, v, p, monitor_)) return;
      if ((points.compare(u, p) < 0) == up && (points.compare(p, v) < 0) == up) inside.push_back(p);
    });
    std::sort(inside.begin(), inside.end(),
              [&](std::uint32_t a, std::uint32_t b) { return (points.compare(a, b) < 0) == up; });
    return inside;
  }

  struct Use {
    std::uint32_t face = 0;
    bool forward = false;
  };
  using Uses = std::unordered_map<std::uint64_t, std::vector<Use>>;

  [[nodiscard]] Uses uses_of_sides(const std::vector<bool>& left_out = {}) const {
    Uses uses;
    for (std::uint32_t f = 0; f < rings_.size(); ++f) {
      if (!left_out.empty() && left_out[f]) continue;
      const Ring& ring = rings_[f];
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t u = ring[i];
        const std::uint32_t v = ring[(i + 1) % ring.size()];
        uses[pair_key(std::min(u, v), std::max(u, v))].push_back({f, u < v});
      }
    }
    return uses;
  }

  // Breadth first over sides of two faces; the larger part of a component keeps its direction. A wall between two
  // solids has both directions, and the faces beside it are each other's neighbours.
  void turn_to_neighbours() {
    const std::vector<bool> is_wall = doubled(rings_);
    const Uses uses = uses_of_sides(is_wall);
    enum class State : std::uint8_t { kUnknown, kKept, kTurned };
    std::vector<State> state(rings_.size(), State::kUnknown);
    turned_.assign(rings_.size(), false);
    std::size_t turned = 0;
    for (std::uint32_t first = 0; first < rings_.size(); ++first) {
      if (state[first] != State::kUnknown || is_wall[first]) continue;
      std::vector<std::uint32_t> part{first};
      std::size_t count = 0;
      state[first] = State::kKept;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const std::uint32_t f = part[i];
        count += state[f] == State::kTurned ? 1 : 0;
        const Ring& ring = rings_[f];
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const std::uint32_t u = ring[k];
          const std::uint32_t v = ring[(k + 1) % ring.size()];
          const std::vector<Use>& pair = uses.at(pair_key(std::min(u, v), std::max(u, v)));
          if (pair.size() != 2 || pair[0].face == pair[1].face) continue;
          const Use& other = pair[0].face == f ? pair[1] : pair[0];
          if (state[other.face] != State::kUnknown) continue;
          const bool alike = pair[0].forward == pair[1].forward;
          state[other.face] = alike == (state[f] == State::kKept) ? State::kTurned : State::kKept;
          part.push_back(other.face);
        }
      }
      const State to_turn = 2 * count > part.size() ? State::kKept : State::kTurned;
      for (const std::uint32_t f : part) {
        if (state[f] != to_turn) continue;
        std::reverse(rings_[f].begin(), rings_[f].end());
        turned_[f] = true;
        ++turned;
      }
    }
    note(turned, "face", "faces", "turned to fit the neighbours");
  }

  void close_holes(RepairedMesh& result) {
    if (options_.fill_holes) {
      const Lids flat = lids_for(vertices_, rings_, LidShape::kFlat, monitor_);
      put_on(flat);
      note(flat.holes, "planar hole", "planar holes", "filled");
    }
    if (options_.close_percent <= 0) {
      result.holes = border_loops(rings_).size();
      return;
    }
    const Lids lids = lids_for(vertices_, rings_, LidShape::kAny, monitor_);
    result.holes = lids.holes;
    result.flat_holes = lids.flat;
    result.lid_share = lids.share;
    result.has_lids = lids.holes > 0 && 100 * lids.share <= options_.close_percent;
    if (!result.has_lids) return;
    put_on(lids);
    done_.push_back(counted(lids.holes, "hole", "holes") + " closed by lids of " + percent_text(lids.share) +
                    " of the area, " + std::to_string(lids.flat) + " of them flat: a guess");
  }

  static std::string percent_text(double share) {
    std::array<char, 32> text{};
    static_cast<void>(std::snprintf(text.data(), text.size(), "%.2g %%", 100 * share));
    return text.data();
  }

  void put_on(const Lids& lids) {
    rings_.insert(rings_.end(), lids.faces.begin(), lids.faces.end());
    turned_.resize(rings_.size(), false);
  }

  struct Component {
    std::vector<std::uint32_t> faces;
    std::optional<Polyhedron> solid;  // nothing if it bounds none
    std::array<Rational3, 2> box;     // of the solid
    bool inward = false;
    bool apart = true;    // crosses no other
    bool turned = false;  // some faces were turned, so how it was turned says little
  };

  // Faces that share sides.
  [[nodiscard]] std::vector<Component> components() const {
    UnionFind faces(rings_.size());
    for (const auto& [key, list] : uses_of_sides()) {
      for (const Use& use : list) faces.unite(use.face, list[0].face);
    }
    std::map<std::uint32_t, Component> by_face;
    for (std::uint32_t f = 0; f < rings_.size(); ++f) by_face[faces.find(f)].faces.push_back(f);
    std::vector<Component> result;
    for (auto& [face, component] : by_face) result.push_back(std::move(component));
    return result;
  }

  void turn_components() {
    std::vector<Component> list = components();
    if (list.size() > 1) find_crossing(list);
    for (Component& component : list) make_solid(component);
    std::size_t turned = 0;
    for (const Component& component : list) {
      if (!component.solid || !component.apart) continue;
      std::size_t around = 0;
      for (const Component& other : list) {
        if (&other != &component && other.solid && encloses(other, component)) ++around;
      }
      if (component.inward == (around % 2 == 1)) continue;
      if (!component.inward && !component.turned && options_.crossings != Crossings::kRefuse) continue;
      ++turned;
      for (const std::uint32_t f : component.faces) std::reverse(rings_[f].begin(), rings_[f].end());
    }
    note(turned, "component", "components", "turned over");
  }

  // By winding numbers other than 0, if they have the same sign everywhere.
  void make_solid(Component& component) const {
    std::vector<Ring> rings;
    for (const std::uint32_t f : component.faces) {
      rings.push_back(rings_[f]);
      component.turned = component.turned || turned_[f];
    }
    const MeshOptions options{.crossings = Crossings::kNonzero, .threads = options_.threads, .monitor = monitor_};
    try {
      ResolvedMesh resolved = resolve_mesh(mesh_of(vertices_, rings), options, nullptr, Measure::kDoubles);
      if (resolved.volumes.begin()->first < 0) return;
      component.solid = std::move(resolved.set);
      component.box = bounding_box(*component.solid, monitor_).value();
      component.inward = resolved.inside_out;
    } catch (const InputError&) {
      // It bounds nothing.
    }
  }

  // Which components cross others.
  void find_crossing(std::vector<Component>& list) const {
    std::vector<std::uint32_t> number(rings_.size());
    for (std::uint32_t c = 0; c < list.size(); ++c) {
      for (const std::uint32_t f : list[c].faces) number[f] = c;
    }
    const MeshSurface surface(mesh_of(vertices_, rings_), monitor_);
    for (const FaceContact& contact : face_contacts(surface, SurfaceContacts(surface, monitor_))) {
      // Faces overlap, too, where a component that is inside out stands on another one.
      const bool crosses = contact.kind == SurfaceContacts::Kind::kCross;
      if (!crosses || number[contact.f] == number[contact.g]) continue;
      list[number[contact.f]].apart = list[number[contact.g]].apart = false;
    }
  }

  static bool in_box(const Rational3& p, const std::array<Rational3, 2>& box) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (p[i] < box[0][i] || p[i] > box[1][i]) return false;
    }
    return true;
  }

  // By a vertex that is not on the other's border.
  [[nodiscard]] bool encloses(const Component& outer, const Component& inner) const {
    for (const std::uint32_t f : inner.faces) {
      for (const std::uint32_t v : rings_[f]) {
        if (!in_box(vertices_[v], outer.box)) return false;
        const Location where = locate(*outer.solid, vertices_[v], monitor_);
        if (where.kind == Location::Kind::kVolume) return where.mark != 0;
      }
    }
    return false;
  }

  std::vector<Rational3> vertices_;
  RepairOptions options_;
  Monitor monitor_;
  std::vector<Ring> rings_;
  std::vector<bool> turned_;  // of each ring: to fit its neighbours
  std::vector<std::string> done_;
};

}  // namespace

RepairedMesh repair_mesh(const Mesh& mesh, const RepairOptions& options, const Monitor& monitor) {
  if (refusal(mesh, monitor).empty()) {
    RepairedMesh sound;
    sound.mesh = mesh;
    return sound;
  }
  return Repairer(mesh, options, monitor).run();
}

}  // namespace nef

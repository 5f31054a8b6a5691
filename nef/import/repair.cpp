// SPDX-License-Identifier: Apache-2.0
//
// A sequence of steps on rings of vertices, each of which keeps what the steps before have done: merge equal vertices,
// drop copies, drop faces without area, make corners where a vertex of the border lies in an open side, turn faces to
// fit their neighbours (breadth first; the larger part of a component keeps its direction), fill planar holes, turn
// components by how many others contain them. The result is imported once to say whether it bounds a solid. No vertex
// is moved or made.
#include "nef/import/repair.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <variant>

#include "nef/base/error.h"
#include "nef/base/union_find.h"
#include "nef/geometry/vectors.h"
#include "nef/import/doubled_faces.h"
#include "nef/import/try_from_mesh.h"
#include "nef/mesh/edge_order.h"
#include "nef/mesh/surface/mesh_surface.h"
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
    fill_holes();
    turn_components();
    RepairedMesh result;
    result.mesh = mesh_of(vertices_, rings_);
    result.done = std::move(done_);
    result.problem = rings_.empty() ? "no face is left of the mesh" : refusal(result.mesh, monitor_);
    return result;
  }

 private:
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

  // Breadth first over sides of two faces; the larger part of a component keeps its direction.
  // A wall between two solids has both directions, and the faces beside it are each other's neighbours.
  void turn_to_neighbours() {
    const std::vector<bool> is_wall = doubled(rings_);
    const Uses uses = uses_of_sides(is_wall);
    enum class State : std::uint8_t { kUnknown, kKept, kTurned };
    std::vector<State> state(rings_.size(), State::kUnknown);
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
        ++turned;
      }
    }
    note(turned, "face", "faces", "turned to fit the neighbours");
  }

  // The border as loops, against the direction of the faces along it.
  [[nodiscard]] std::vector<Ring> border_loops() const {
    std::multimap<std::uint32_t, std::uint32_t> next;
    for (const auto& [key, list] : uses_of_sides()) {
      if (list.size() != 1) continue;
      const auto low = static_cast<std::uint32_t>(key >> 32U);
      const auto high = static_cast<std::uint32_t>(key & 0xffffffffU);
      next.emplace(list[0].forward ? high : low, list[0].forward ? low : high);
    }
    std::vector<Ring> loops;
    while (!next.empty()) {
      Ring loop;
      std::uint32_t at = next.begin()->first;
      for (auto step = next.find(at); step != next.end(); step = next.find(at)) {
        loop.push_back(at);
        at = step->second;
        next.erase(step);
      }
      if (at == loop.front()) loops.push_back(std::move(loop));
    }
    return loops;
  }

  void fill_holes() {
    if (!options_.fill_holes) return;
    std::size_t filled = 0;
    for (Ring& loop : border_loops()) {
      const Mesh lid = mesh_of(vertices_, {loop});
      const MeshSurface surface(lid, monitor_);
      if (surface.defects[0] != FaceDefect::kNone || !surface.planar[0]) continue;
      rings_.push_back(std::move(loop));
      ++filled;
    }
    note(filled, "planar hole", "planar holes", "filled");
  }

  struct Component {
    std::vector<std::uint32_t> faces;
    std::optional<Polyhedron> solid;  // nothing if it bounds none
    std::array<Rational3, 2> box;     // of the solid
    bool inward = false;
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

  [[nodiscard]] Rational signed_volume(const Component& component) const {
    Rational sum;
    for (const std::uint32_t f : component.faces) {
      const Ring& ring = rings_[f];
      for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        sum += dot(vertices_[ring[0]], cross(vertices_[ring[i]], vertices_[ring[i + 1]]));
      }
    }
    return sum;
  }

  void turn_components() {
    std::vector<Component> list = components();
    for (Component& component : list) {
      std::vector<Ring> rings;
      for (const std::uint32_t f : component.faces) rings.push_back(rings_[f]);
      std::variant<Polyhedron, MeshRefusal> made = try_from_mesh(mesh_of(vertices_, rings), {.monitor = monitor_});
      auto* solid = std::get_if<Polyhedron>(&made);
      if (solid == nullptr) continue;
      component.solid = std::move(*solid);
      component.box = bounding_box(*component.solid, monitor_).value();
      component.inward = signed_volume(component) < 0;
    }
    std::size_t turned = 0;
    for (const Component& component : list) {
      if (!component.solid) continue;
      std::size_t around = 0;
      for (const Component& other : list) {
        if (&other != &component && other.solid && encloses(other, component)) ++around;
      }
      if (component.inward == (around % 2 == 1)) continue;
      ++turned;
      for (const std::uint32_t f : component.faces) std::reverse(rings_[f].begin(), rings_[f].end());
    }
    note(turned, "component", "components", "turned over");
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
  std::vector<std::string> done_;
};

}  // namespace

RepairedMesh repair_mesh(const Mesh& mesh, const RepairOptions& options, const Monitor& monitor) {
  if (refusal(mesh, monitor).empty()) return {mesh, {}, ""};
  return Repairer(mesh, options, monitor).run();
}

}  // namespace nef

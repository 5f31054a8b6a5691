// SPDX-License-Identifier: Apache-2.0
//
// With a rule, most meshes have no component to turn: the volume that the faces of each enclose with their signs says
// so. Solids are made of those that remain, and of others as they are found to be around one.
#include "nef/import/repair/turn_components.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <unordered_map>

#include "nef/base/error.h"
#include "nef/base/union_find.h"
#include "nef/import/repair/signed_volume.h"
#include "nef/import/resolve_mesh.h"
#include "nef/mesh/edge_order.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

struct Component {
  std::span<const std::uint32_t> faces;
  bool apart = true;    // crosses no other
  bool turned = false;  // some faces were turned, so how it was turned says little
  bool is_made = false;
  std::optional<Polyhedron> solid;  // nothing if it bounds none
  bool inward = false;
  std::array<Rational3, 2> box;
};

class ComponentTurner {
 public:
  ComponentTurner(MeshInRepair& mesh, Crossings rule, const Monitor& monitor)
      : mesh_(mesh), rule_(rule), monitor_(monitor) {}

  std::size_t run(std::span<const std::vector<std::uint32_t>> components, std::span<const FaceContact> contacts) {
    for (const std::vector<std::uint32_t>& faces : components) {
      Component& component = list_.emplace_back();
      component.faces = faces;
      component.box = box_of(faces);
      for (const std::uint32_t f : faces) component.turned = component.turned || mesh_.turned[f];
    }
    find_crossing(contacts);
    std::vector<const Component*> to_turn;
    for (Component& component : list_) {
      if (is_to_turn(component)) to_turn.push_back(&component);
    }
    for (const Component* component : to_turn) {
      for (const std::uint32_t f : component->faces) mesh_.turn_over(f);
    }
    return to_turn.size();
  }

 private:
  [[nodiscard]] std::array<Rational3, 2> box_of(std::span<const std::uint32_t> faces) const {
    std::array<Rational3, 2> box{mesh_.vertices[mesh_.rings[faces[0]][0]], mesh_.vertices[mesh_.rings[faces[0]][0]]};
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : mesh_.rings[f]) {
        for (std::size_t i = 0; i < 3; ++i) {
          box[0][i] = std::min(box[0][i], mesh_.vertices[v][i]);
          box[1][i] = std::max(box[1][i], mesh_.vertices[v][i]);
        }
      }
    }
    return box;
  }

  // Which components cross others.
  void find_crossing(std::span<const FaceContact> contacts) {
    std::vector<std::uint32_t> number(mesh_.rings.size());
    for (std::uint32_t c = 0; c < list_.size(); ++c) {
      for (const std::uint32_t f : list_[c].faces) number[f] = c;
    }
    for (const FaceContact& contact : contacts) {
      // Faces overlap, too, where a component that is inside out stands on another one.
      const bool crosses = contact.kind == SurfaceContacts::Kind::kCross;
      if (!crosses || number[contact.f] == number[contact.g]) continue;
      list_[number[contact.f]].apart = list_[number[contact.g]].apart = false;
    }
  }

  bool is_to_turn(Component& component) {
    if (!component.apart) return false;
    const bool may_stay_outward = rule_ != Crossings::kRefuse && !component.turned;
    if (may_stay_outward && is_surely_outward(component)) return false;
    make_solid(component);
    if (!component.solid || (may_stay_outward && !component.inward)) return false;
    std::size_t around = 0;
    for (Component& other : list_) {
      if (&other != &component && encloses(other, component)) ++around;
    }
    return component.inward != (around % 2 == 1);
  }

  [[nodiscard]] bool is_surely_outward(const Component& component) const {
    const MeasuredVolume volume = signed_volume(mesh_.mesh(component.faces), monitor_);
    return volume.value > volume.error;
  }

  // By winding numbers other than 0, if they have the same sign everywhere.
  void make_solid(Component& component) const {
    if (component.is_made) return;
    component.is_made = true;
    const MeshOptions options{.crossings = Crossings::kNonzero, .monitor = monitor_};
    try {
      ResolvedMesh resolved = resolve_mesh(mesh_.mesh(component.faces), options, nullptr, Measure::kNot);
      if (resolved.lowest < 0) return;
      component.solid = std::move(resolved.set);
      component.inward = resolved.inside_out;
    } catch (const InputError&) {
      // It bounds nothing.
    }
  }

  static bool in_box(const Rational3& p, const std::array<Rational3, 2>& box) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (p[i] < box[0][i] || p[i] > box[1][i]) return false;
    }
    return true;
  }

  // By a vertex that is not on the other's border.
  [[nodiscard]] bool encloses(Component& outer, const Component& inner) const {
    for (const std::uint32_t f : inner.faces) {
      for (const std::uint32_t v : mesh_.rings[f]) {
        if (!in_box(mesh_.vertices[v], outer.box)) return false;
        make_solid(outer);
        if (!outer.solid) return false;
        const Location where = locate(*outer.solid, mesh_.vertices[v], monitor_);
        if (where.kind == Location::Kind::kVolume) return where.mark != 0;
      }
    }
    return false;
  }

  MeshInRepair& mesh_;
  Crossings rule_;
  Monitor monitor_;
  std::vector<Component> list_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> components_by_sides(const MeshInRepair& mesh) {
  UnionFind faces(mesh.rings.size());
  std::unordered_map<std::uint64_t, std::uint32_t> first;
  for (std::uint32_t f = 0; f < mesh.rings.size(); ++f) {
    for_each_side(mesh.rings[f], [&](std::uint32_t u, std::uint32_t v) {
      faces.unite(first.emplace(edge_key(u, v), f).first->second, f);
    });
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> by_root;
  for (std::uint32_t f = 0; f < mesh.rings.size(); ++f) by_root[faces.find(f)].push_back(f);
  std::vector<std::vector<std::uint32_t>> result;
  result.reserve(by_root.size());
  for (auto& [root, component] : by_root) result.push_back(std::move(component));
  return result;
}

std::size_t turn_components(MeshInRepair& mesh, std::span<const std::vector<std::uint32_t>> components,
                            std::span<const FaceContact> contacts, Crossings rule, const Monitor& monitor) {
  return ComponentTurner(mesh, rule, monitor).run(components, contacts);
}

}  // namespace nef

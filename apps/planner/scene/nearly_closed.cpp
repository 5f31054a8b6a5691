// SPDX-License-Identifier: Apache-2.0
//
// 1. Equal vertices are merged, and copies of faces and faces without area dropped, by the steps of a repair.
// 2. Each connected part becomes a surface, whose volumes have winding numbers modulo 2; if no two ways to one
// disagree,
//    the odd ones are filled.
// 3. Parts with nothing odd are tried once more together, as walls and a floor close each other.
// 4. The number of other parts that contain a part (one vertex tells, where surfaces do not meet) is its depth. Depths
//    are combined from the outermost inward: even ones are added, odd ones that are cavities removed.
#include "apps/planner/scene/nearly_closed.h"

#include <algorithm>
#include <map>
#include <optional>

#include "nef/base/union_find.h"
#include "nef/complex/rewrite_sphere_maps.h"
#include "nef/import/repair/fill.h"
#include "nef/import/repair/repair_steps.h"
#include "nef/mesh/mesh_piece.h"

namespace nef::planner {
namespace {

// Meshes of the connected parts; all share the vertices of the whole.
std::vector<Mesh> connected_parts(const Mesh& mesh) {
  UnionFind sets(mesh.vertices.size());
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    for (const std::uint32_t v : mesh.face(f)) sets.unite(mesh.face(f)[0], v);
  }
  std::map<std::uint32_t, MeshPiece> parts;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    parts.try_emplace(sets.find(mesh.face(f)[0]), mesh.vertices).first->second.push(mesh.face(f));
  }
  std::vector<Mesh> result;
  for (auto& [root, part] : parts) result.push_back(part.take());
  return result;
}

// The surface with its odd volumes filled; nothing if it has none or is ambiguous.
std::optional<Polyhedron> filled(const Polyhedron& surface, const Monitor& monitor) {
  const std::optional<IndexedVector<VolumeId, int>> odd = winding_numbers(surface.complex(), Covering::kParity);
  if (!odd || std::find(odd->begin(), odd->end(), 1) == odd->end()) return std::nullopt;
  Complex c = surface.complex();
  rewrite_sphere_maps(c, [&c, &odd](VertexId v, SphereMapBuffer& map) {
    const SFaceId first = c.vertices[v].sfaces;
    for (std::uint32_t f = 0; f < map.sfaces.size(); ++f) {
      map.sfaces[f].mark = static_cast<LabelId>((*odd)[c.sface_volume(first + f)]);
    }
  });
  for (const VolumeId v : c.volumes.ids()) c.volumes[v].mark = static_cast<LabelId>((*odd)[v]);
  return closure(Polyhedron(std::move(c)), monitor);  // drops what is inside now
}

Polyhedron surface_of(const Mesh& mesh, const Monitor& monitor) {
  MeshOptions options;
  options.as_surface = true;
  options.monitor = monitor;
  return from_mesh(mesh, options);
}

struct Shell {
  Polyhedron set;  // filled
  Polyhedron surface;
  std::array<Rational3, 2> box;
  std::size_t depth = 0;               // in how many others it lies
  std::vector<std::size_t> touched{};  // others that its surface meets
};

enum class Boxes { kApart, kMeet, kInside };

Boxes compare(const std::array<Rational3, 2>& inner, const std::array<Rational3, 2>& outer) {
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    if (inner[0][i] > outer[1][i] || inner[1][i] < outer[0][i]) return Boxes::kApart;
    inside = inside && inner[0][i] > outer[0][i] && inner[1][i] < outer[1][i];
  }
  return inside ? Boxes::kInside : Boxes::kMeet;
}

// Which parts touch others, and in how many each is nested.
void find_nesting(std::vector<Shell>& parts, const Monitor& monitor) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = i + 1; k < parts.size(); ++k) {
      if (compare(parts[i].box, parts[k].box) == Boxes::kApart) continue;
      if (!intersect(parts[i].surface, parts[k].surface, monitor).is_empty()) {
        parts[i].touched.push_back(k);
        parts[k].touched.push_back(i);
        continue;
      }
      // Surfaces that do not meet: one vertex tells on which side the other is.
      for (const auto& [inner, outer] : {std::pair(i, k), std::pair(k, i)}) {
        if (compare(parts[inner].box, parts[outer].box) != Boxes::kInside) continue;
        const Rational3 vertex = parts[inner].surface.complex().points.rational(PointId(0U));
        if (contains(parts[outer].set, vertex)) ++parts[inner].depth;
      }
    }
  }
}

Rational box_volume(const Shell& part) {
  Rational product = 1;
  for (std::size_t i = 0; i < 3; ++i) product *= part.box[1][i] - part.box[0][i];
  return product;
}

// Of parts that touch each other inside of another one, the largest is the room, the others stand in it.
bool is_cavity(const std::vector<Shell>& parts, std::size_t i) {
  if (parts[i].depth % 2 == 0) return false;
  return std::none_of(parts[i].touched.begin(), parts[i].touched.end(), [&](std::size_t k) {
    if (parts[k].depth != parts[i].depth) return false;
    const int order = cmp(box_volume(parts[k]), box_volume(parts[i]));
    return order > 0 || (order == 0 && k < i);
  });
}

// A solid part that is not around a cavity of this depth but meets its surface.
bool reaches_into_cavity(const std::vector<Shell>& parts, std::size_t i, std::size_t depth) {
  return std::any_of(parts[i].touched.begin(), parts[i].touched.end(),
                     [&](std::size_t k) { return parts[k].depth == depth && is_cavity(parts, k); });
}

// From the outermost inward, so that what stands in a cavity is there again.
Polyhedron combined(std::vector<Shell>& parts, const Monitor& monitor) {
  find_nesting(parts, monitor);
  std::map<std::size_t, std::vector<Polyhedron>> by_depth;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t depth = parts[i].depth;
    by_depth[depth % 2 == 1 && !is_cavity(parts, i) ? depth + 1 : depth].push_back(parts[i].set);
  }
  Polyhedron result;
  for (auto& [depth, sets] : by_depth) {
    const Polyhedron all = unite_all(sets, monitor);
    if (depth % 2 == 0) {
      result = unite(result, all, monitor);
      continue;
    }
    result = subtract(result, interior(all, monitor), monitor);
    // What reaches in from outside is there, too.
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].depth % 2 == 0 && reaches_into_cavity(parts, i, depth)) {
        result = unite(result, parts[i].set, monitor);
      }
    }
  }
  return result;
}

}  // namespace

MeshMeaning meaning_of(const Mesh& mesh, const Monitor& monitor) {
  MeshMeaning meaning;
  MeshInRepair faces(mesh);
  drop_copies(faces);
  drop_faces_without_area(faces, monitor);
  const Mesh clean = faces.mesh();
  meaning.duplicate_faces = mesh.face_count() - clean.face_count();
  std::vector<Shell> parts;
  const auto add_solid = [&](const Polyhedron& set, const Polyhedron& surface) {
    ++meaning.solid_parts;
    if (!set.is_regular()) ++meaning.surface_parts;
    parts.push_back({set, surface, *bounding_box(set)});
  };
  std::size_t open_parts = 0;
  std::vector<Polyhedron> surfaces;
  for (const Mesh& part : connected_parts(clean)) {
    const Polyhedron surface = surface_of(part, monitor);
    if (const std::optional<Polyhedron> set = filled(surface, monitor)) {
      add_solid(*set, surface);
      continue;
    }
    ++open_parts;
    surfaces.push_back(surface);
  }
  // Parts that are open by themselves may close each other (walls and a floor that share no vertices).
  const Polyhedron together = unite_all(surfaces, monitor);
  if (const std::optional<Polyhedron> set = open_parts > 1 ? filled(together, monitor) : std::nullopt) {
    add_solid(*set, together);
    meaning.set = combined(parts, monitor);
  } else {
    meaning.surface_parts += open_parts;
    meaning.set = unite(combined(parts, monitor), together, monitor);
  }
  return meaning;
}

}  // namespace nef::planner

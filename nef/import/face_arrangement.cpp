// SPDX-License-Identifier: Apache-2.0
#include "nef/import/face_arrangement.h"

#include <queue>
#include <utility>
#include <vector>

#include "nef/geometry/ids.h"
#include "nef/import/contact_groups.h"
#include "nef/import/mesh_faces.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

LabelId mark_of_net(int net) { return net > 0 ? 2 * static_cast<LabelId>(net) - 1 : 2 * static_cast<LabelId>(-net); }

LabelId sum_of_nets(LabelId a, LabelId b) { return mark_of_net(net_of_mark(a) + net_of_mark(b)); }
LabelId one_of_two(LabelId a, LabelId b) { return (a != 0) != (b != 0) ? 1 : 0; }
LabelId any_of_two(LabelId a, LabelId b) { return a != 0 || b != 0 ? 1 : 0; }

// Smallest first, so that the largest set, which has nearly all faces, is copied once.
Polyhedron overlay_all(std::vector<Polyhedron> sets, Covering covering, const MeshOptions& options) {
  const auto join = covering == Covering::kSigned   ? sum_of_nets
                    : covering == Covering::kParity ? one_of_two
                                                    : any_of_two;
  const auto larger = [&](std::size_t i, std::size_t j) {
    const std::size_t a = sets[i].complex().vertex_count();
    const std::size_t b = sets[j].complex().vertex_count();
    return a != b ? a > b : i > j;
  };
  std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(larger)> waiting(larger);
  for (std::size_t i = 0; i < sets.size(); ++i) waiting.push(i);
  while (waiting.size() > 1) {
    const std::size_t small = waiting.top();
    waiting.pop();
    const std::size_t large = waiting.top();
    waiting.pop();
    // The first operand's vertices come first and are copied in long runs.
    sets[large] = overlay(sets[large], sets[small], join, options.monitor);
    sets[small] = Polyhedron();
    waiting.push(large);
  }
  return std::move(sets[waiting.top()]);
}

}  // namespace

int net_of_mark(LabelId mark) {
  const int half = static_cast<int>((mark + 1) / 2);
  return mark % 2 == 1 ? half : -half;
}

Polyhedron arrange_faces(const Mesh& mesh, std::unique_ptr<const MeshSurface> surface,
                         std::span<const FaceContact> contacts, Covering covering, const MeshOptions& options,
                         Messages* messages) {
  std::vector<std::uint32_t> components = face_components(mesh, *surface);
  for (std::size_t f = 0; f < components.size(); ++f) {
    if (surface->defects[f] != FaceDefect::kNone) components[f] = kNone;
  }
  std::vector<Polyhedron> parts;
  {
    MeshFaces faces(mesh, *surface, options, messages);
    for (const std::vector<std::uint32_t>& group : contact_groups(contacts, components)) {
      parts.emplace_back(covering == Covering::kSigned ? faces.oriented_surface(group) : faces.surface(group));
    }
  }
  surface.reset();
  return parts.empty() ? Polyhedron() : overlay_all(std::move(parts), covering, options);
}

}  // namespace nef

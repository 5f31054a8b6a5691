// SPDX-License-Identifier: Apache-2.0
//
// All steps work on rings of vertices. Sides are found by sorted maps or hash tables of pairs of vertices; vertices in
// sides by a tree of the boxes of the border.
#include "nef/import/repair/repair_steps.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>

#include "nef/base/counted.h"
#include "nef/base/error.h"
#include "nef/geometry/ids.h"
#include "nef/geometry/search/box_tree.h"
#include "nef/import/repair/doubled_faces.h"
#include "nef/import/repair/turn_components.h"
#include "nef/mesh/edge_order.h"
#include "nef/mesh/mesh_piece.h"
#include "nef/mesh/surface/mesh_surface.h"
#include "nef/mesh/vertex_merger.h"

namespace nef {
namespace {

using Ring = std::vector<std::uint32_t>;
using VertexPair = std::array<std::uint32_t, 2>;

// As pairs of places.
std::set<VertexPair> open_sides(const std::vector<Ring>& rings, OpenSides which) {
  std::map<VertexPair, int> uses;  // for kUnbalanced, those from the smaller place less the others
  for (const Ring& ring : rings) {
    for_each_side(ring, [&](std::uint32_t u, std::uint32_t v) {
      uses[{std::min(u, v), std::max(u, v)}] += which == OpenSides::kUnbalanced && u > v ? -1 : 1;
    });
  }
  std::set<VertexPair> open;
  for (const auto& [side, count] : uses) {
    if (which == OpenSides::kOdd ? count % 2 == 1 : count != 0) open.insert(side);
  }
  return open;
}

// Those of the border in a side, along it.
Ring vertices_between(const MeshPoints& points, const BoxTree& tree, const std::vector<std::uint32_t>& border,
                      VertexPair side, const Monitor& monitor) {
  const std::uint32_t u = side[0];
  const std::uint32_t v = side[1];
  Box box;
  points.extend(box, u);
  points.extend(box, v);
  Ring inside;
  const bool up = points.compare(u, v) < 0;
  tree.for_each_overlap(box, [&](std::uint32_t i) {
    const std::uint32_t p = border[i];
    if (p == u || p == v || !points.collinear(u, v, p, monitor)) return;
    if ((points.compare(u, p) < 0) == up && (points.compare(p, v) < 0) == up) inside.push_back(p);
  });
  std::sort(inside.begin(), inside.end(),
            [&](std::uint32_t a, std::uint32_t b) { return (points.compare(a, b) < 0) == up; });
  return inside;
}

struct SideUse {
  std::uint32_t face = 0;
  bool forward = false;
};
using SideUses = std::unordered_map<std::uint64_t, std::vector<SideUse>>;

// Of the faces those of these numbers stay, with these rings; the others are copies.
void keep_faces(MeshInRepair& mesh, std::vector<Ring> rings, const std::vector<std::uint32_t>& numbers) {
  std::vector<bool> stays(mesh.rings.size(), false);
  for (const std::uint32_t f : numbers) stays[f] = true;
  for (std::size_t f = 0; f < stays.size(); ++f) {
    if (!stays[f]) mesh.fates[mesh.sources[f]] = FaceFate::kCopy;
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::uint32_t f = numbers[i];
    mesh.turned_over[i] = mesh.turned_over[f] != (rings[i] != mesh.rings[f]);  // the second one of a wall
    mesh.sources[i] = mesh.sources[f];
  }
  mesh.sources.resize(numbers.size());
  mesh.turned_over.resize(numbers.size());
  mesh.rings = std::move(rings);
}

// Returns how many go.
std::size_t drop_faces(MeshInRepair& mesh, const std::vector<bool>& goes, FaceFate fate) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < goes.size(); ++f) {
    if (goes[f]) {
      mesh.fates[mesh.sources[f]] = fate;
      continue;
    }
    mesh.sources[kept] = mesh.sources[f];
    mesh.turned_over[kept] = mesh.turned_over[f];
    mesh.turned[kept] = mesh.turned[f];
    if (kept != f) mesh.rings[kept] = std::move(mesh.rings[f]);
    ++kept;
  }
  mesh.sources.resize(kept);
  mesh.turned_over.resize(kept);
  mesh.turned.resize(kept);
  mesh.rings.resize(kept);
  return goes.size() - kept;
}

// Faces that are there again, turned alike, go if they are closed by themselves: then all sides stay balanced.
void drop_repeated(MeshInRepair& mesh) {
  const std::vector<std::uint32_t> again = repeated(mesh.rings);
  std::vector<Ring> dropped;
  for (const std::uint32_t f : again) dropped.push_back(mesh.rings[f]);
  if (again.empty() || !border_loops(dropped).empty()) return;
  std::vector<std::uint32_t> kept;
  std::vector<Ring> left;
  for (std::uint32_t f = 0; f < mesh.rings.size(); ++f) {
    if (std::binary_search(again.begin(), again.end(), f)) continue;
    kept.push_back(f);
    left.push_back(mesh.rings[f]);
  }
  keep_faces(mesh, std::move(left), kept);
}

// By pair_key; of the faces that are not left out.
SideUses uses_of_sides(const std::vector<Ring>& rings, const std::vector<bool>& left_out) {
  SideUses uses;
  for (std::uint32_t f = 0; f < rings.size(); ++f) {
    if (left_out[f]) continue;
    for_each_side(rings[f], [&](std::uint32_t u, std::uint32_t v) { uses[edge_key(u, v)].push_back({f, u < v}); });
  }
  return uses;
}

// True if there are no points off it.
bool lie_in_one_plane(const MeshPoints& points, const Ring& corners, const Monitor& monitor) {
  std::size_t second = 1;
  while (second < corners.size() && points.compare(corners[0], corners[second]) == 0) ++second;
  std::size_t third = second + 1;
  while (third < corners.size() && points.collinear(corners[0], corners[second], corners[third], monitor)) ++third;
  return third + 1 >= corners.size() ||
         points.coplanar(corners[0], corners[second], corners[third], std::span(corners).subspan(third + 1));
}

}  // namespace

MeshInRepair::MeshInRepair(const Mesh& mesh) : vertices(mesh.vertices), fates(mesh.face_count(), FaceFate::kKept) {
  const std::vector<std::uint32_t> place = merge_equal(mesh.vertices);
  std::size_t merged = 0;
  for (std::uint32_t v = 0; v < place.size(); ++v) merged += place[v] != v ? 1 : 0;
  note(merged, "vertex", "vertices", "merged with another of the same coordinates");
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    Ring& ring = rings.emplace_back();
    for (const std::uint32_t v : mesh.face(f)) {
      if (v >= place.size()) throw InputError("face " + std::to_string(f) + " names a vertex that does not exist");
      if (ring.empty() || ring.back() != place[v]) ring.push_back(place[v]);
    }
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    sources.push_back(f);
  }
  turned_over.assign(rings.size(), false);
  turned.assign(rings.size(), false);
}

Mesh MeshInRepair::mesh() const {
  MeshPiece piece(vertices);
  for (const Ring& ring : rings) piece.push(ring);
  return piece.take();
}

Mesh MeshInRepair::mesh(std::span<const std::uint32_t> faces) const {
  MeshPiece piece(vertices);
  for (const std::uint32_t f : faces) piece.push(rings[f]);
  return piece.take();
}

bool MeshInRepair::is(const Mesh& mesh) const {
  if (rings.size() != mesh.face_count()) return false;
  for (std::uint32_t f = 0; f < rings.size(); ++f) {
    const auto face = mesh.face(f);
    if (!std::equal(face.begin(), face.end(), rings[f].begin(), rings[f].end())) return false;
  }
  return true;
}

void MeshInRepair::turn_over(std::uint32_t face) {
  // From the same corner: a ring that crosses itself is cut as a fan from there.
  if (!rings[face].empty()) std::reverse(rings[face].begin() + 1, rings[face].end());
  turned_over[face] = !turned_over[face];
}

void MeshInRepair::note(std::size_t count, const char* one, const char* many, const char* what) {
  if (count > 0) done.push_back(counted(count, one, many) + " " + what);
}

bool is_balanced(const MeshInRepair& mesh) { return border_loops(mesh.rings).empty(); }

void drop_copies(MeshInRepair& mesh) {
  const bool balanced = is_balanced(mesh);
  std::vector<std::uint32_t> kept;
  std::vector<Ring> left = without_copies(mesh.rings, &kept, balanced);
  const std::size_t before = mesh.rings.size();
  keep_faces(mesh, std::move(left), kept);
  if (balanced) drop_repeated(mesh);
  mesh.note(before - mesh.rings.size(), "face", "faces", "with the corners of another dropped");
}

void drop_faces_without_area(MeshInRepair& mesh, const Monitor& monitor) {
  const MeshSurface surface(mesh.mesh(), monitor);
  std::vector<bool> goes(mesh.rings.size(), false);
  for (std::size_t f = 0; f < goes.size(); ++f) {
    const FaceDefect defect = surface.defects[f];
    goes[f] = defect == FaceDefect::kNoArea || defect == FaceDefect::kTooFewCorners;
  }
  mesh.note(drop_faces(mesh, goes, FaceFate::kNoArea), "face", "faces", "without area dropped");
}

void split_sides(MeshInRepair& mesh, OpenSides which, const Monitor& monitor) {
  const std::set<VertexPair> open = open_sides(mesh.rings, which);
  if (open.empty()) return;
  const MeshPoints points(mesh.vertices);
  std::vector<std::uint32_t> border;
  for (const auto& [u, v] : open) border.insert(border.end(), {u, v});
  std::sort(border.begin(), border.end());
  border.erase(std::unique(border.begin(), border.end()), border.end());
  std::vector<Box> boxes(border.size());
  for (std::size_t i = 0; i < border.size(); ++i) points.extend(boxes[i], border[i]);
  const BoxTree tree(boxes);
  std::size_t split = 0;
  for (Ring& ring : mesh.rings) {
    Ring longer;
    for_each_side(ring, [&](std::uint32_t u, std::uint32_t v) {
      longer.push_back(u);
      if (open.count({std::min(u, v), std::max(u, v)}) == 0) return;
      Ring inside = vertices_between(points, tree, border, {u, v}, monitor);
      split += inside.size();
      longer.insert(longer.end(), inside.begin(), inside.end());
    });
    ring = std::move(longer);
  }
  mesh.note(split, "vertex", "vertices", "on the side of a face made a corner of it");
}

void turn_to_neighbours(MeshInRepair& mesh) {
  const std::vector<bool> is_wall = doubled(mesh.rings);
  const SideUses uses = uses_of_sides(mesh.rings, is_wall);
  enum class State : std::uint8_t { kUnknown, kKept, kTurned };
  std::vector<State> state(mesh.rings.size(), State::kUnknown);
  mesh.turned.assign(mesh.rings.size(), false);
  std::size_t turned = 0;
  for (std::uint32_t first = 0; first < mesh.rings.size(); ++first) {
    if (state[first] != State::kUnknown || is_wall[first]) continue;
    std::vector<std::uint32_t> part{first};
    std::size_t count = 0;
    state[first] = State::kKept;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::uint32_t f = part[i];
      count += state[f] == State::kTurned ? 1 : 0;
      for_each_side(mesh.rings[f], [&](std::uint32_t u, std::uint32_t v) {
        const std::vector<SideUse>& pair = uses.at(edge_key(u, v));
        if (pair.size() != 2 || pair[0].face == pair[1].face) return;
        const SideUse& other = pair[0].face == f ? pair[1] : pair[0];
        const bool alike = pair[0].forward == pair[1].forward;
        const State wanted = alike == (state[f] == State::kKept) ? State::kTurned : State::kKept;
        if (state[other.face] != State::kUnknown) {
          if (state[other.face] != wanted) mesh.one_sided = std::min(mesh.one_sided, mesh.sources[f]);
          return;
        }
        state[other.face] = wanted;
        part.push_back(other.face);
      });
    }
    const State to_turn = 2 * count > part.size() ? State::kKept : State::kTurned;
    for (const std::uint32_t f : part) {
      if (state[f] != to_turn) continue;
      mesh.turn_over(f);
      mesh.turned[f] = true;
      ++turned;
    }
  }
  mesh.note(turned, "face", "faces", "flipped to match adjacent faces");
}

bool is_flat(const MeshInRepair& mesh, const Monitor& monitor) {
  Ring corners;
  for (const Ring& ring : mesh.rings) corners.insert(corners.end(), ring.begin(), ring.end());
  return lie_in_one_plane(MeshPoints(mesh.vertices), corners, monitor);
}

bool drop_flat_pieces(MeshInRepair& mesh, const Lids& lids, const Monitor& monitor) {
  if (lids.flat == 0) return false;
  MeshInRepair closed = mesh;
  put_on(closed, lids);
  const MeshPoints points(mesh.vertices);
  std::vector<bool> goes(mesh.rings.size(), false);
  std::size_t pieces = 0;
  std::size_t faces = 0;
  for (const Ring& piece : components_by_sides(closed)) {
    if (piece.back() < goes.size()) continue;  // no lid, as lids come last
    Ring corners;
    for (const std::uint32_t f : piece) corners.insert(corners.end(), closed.rings[f].begin(), closed.rings[f].end());
    if (!lie_in_one_plane(points, corners, monitor)) continue;
    ++pieces;
    for (const std::uint32_t f : piece) {
      if (f >= goes.size()) break;
      goes[f] = true;
      ++faces;
    }
  }
  if (faces == 0 || faces == goes.size()) return false;
  mesh.done.push_back(counted(pieces, "flat piece", "flat pieces") + " (" + counted(faces, "face", "faces") +
                      ") left out: no lid makes " + (pieces == 1 ? "it" : "them") + " enclose anything");
  drop_faces(mesh, goes, FaceFate::kInside);
  return true;
}

void put_on(MeshInRepair& mesh, const Lids& lids) {
  mesh.rings.insert(mesh.rings.end(), lids.faces.begin(), lids.faces.end());
  mesh.turned.resize(mesh.rings.size(), false);
  mesh.turned_over.resize(mesh.rings.size(), false);
  mesh.sources.resize(mesh.rings.size(), kNone);
}

}  // namespace nef

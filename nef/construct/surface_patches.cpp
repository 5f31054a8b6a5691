// SPDX-License-Identifier: Apache-2.0
//
// Let q lie on one side of the plane of p but for corners that are corners of p, too. Then q meets that plane in these
// corners and in edges between them. One corner is nothing beyond what they share, and neither are two, unless an edge
// of q joins them and none of p does: such an edge may run through p.
#include "nef/construct/surface_patches.h"

#include <algorithm>
#include <array>

namespace nef {
namespace {

bool adjacent(std::uint32_t i, std::uint32_t j, std::size_t size) {
  const std::uint32_t gap = i < j ? j - i : i - j;
  return gap == 1 || gap + 1 == size;
}

}  // namespace

SurfacePatches::SurfacePatches(const MeshSurface& surface) : surface_(surface) {
  const auto count = static_cast<std::uint32_t>(surface.triangles.size());
  for (std::uint32_t t = 0; t < count;) {
    const std::uint32_t f = surface.face_of[t];
    Patch patch{t, t + 1, true};
    if (surface.planar[f]) {
      while (patch.last < count && surface.face_of[patch.last] == f) ++patch.last;
      patch.convex = surface.pieces[patch.first] == surface.pieces[patch.last - 1];
    }
    patches_.push_back(patch);
    t = patch.last;
  }
  corner_begin_.assign(surface.points.size() + 1, 0);
  for (const std::uint32_t place : surface.rings) ++corner_begin_[place + 1];
  for (std::size_t v = 1; v < corner_begin_.size(); ++v) corner_begin_[v] += corner_begin_[v - 1];
  corners_.resize(surface.rings.size());
  std::vector<std::uint32_t> at(corner_begin_.begin(), corner_begin_.end() - 1);
  for (const Patch& patch : patches_) {
    if (patch.size() == 1) continue;
    const std::span<const std::uint32_t> ring = corners(patch);
    for (std::uint32_t i = 0; i < ring.size(); ++i) corners_[at[ring[i]]++] = {surface.face_of[patch.first], i};
  }
}

std::span<const std::uint32_t> SurfacePatches::corners(const Patch& patch) const {
  if (patch.size() == 1) return surface_.triangles[patch.first];
  return surface_.ring(surface_.face_of[patch.first]);
}

// Of a corner in the ring of a patch.
std::optional<std::uint32_t> SurfacePatches::position(const Patch& patch, std::uint32_t place) const {
  if (patch.size() == 1) {
    const std::array<std::uint32_t, 3>& t = surface_.triangles[patch.first];
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (t[i] == place) return i;
    }
    return std::nullopt;
  }
  return position_in_face(surface_.face_of[patch.first], place);
}

// In the ring of a planar face of more than one triangle; nothing for other faces.
std::optional<std::uint32_t> SurfacePatches::position_in_face(std::uint32_t face, std::uint32_t place) const {
  for (std::uint32_t i = corner_begin_[place]; i < corner_begin_[place + 1]; ++i) {
    if (corners_[i].face == face) return corners_[i].position;
  }
  return std::nullopt;
}

bool SurfacePatches::is_cut(std::uint32_t triangle, std::uint32_t u, std::uint32_t v) const {
  const std::uint32_t face = surface_.face_of[triangle];
  const std::optional<std::uint32_t> i = position_in_face(face, u);
  const std::optional<std::uint32_t> j = position_in_face(face, v);
  return i && j && !adjacent(*i, *j, surface_.ring(face).size());
}

bool SurfacePatches::on_plane(std::uint32_t triangle, std::uint32_t place) const {
  for (std::uint32_t i = corner_begin_[place]; i < corner_begin_[place + 1]; ++i) {
    if (corners_[i].face == surface_.face_of[triangle]) return true;
  }
  return false;
}

// True if the plane of p shows that the two have nothing in common beyond shared corners and a shared edge.
bool SurfacePatches::apart(const Patch& p, const Patch& q) const {
  const std::array<std::uint32_t, 3>& plane = surface_.triangles[p.first];
  const std::span<const std::uint32_t> ring = corners(q);
  std::array<std::uint32_t, 2> in_p{};
  std::array<std::uint32_t, 2> in_q{};
  std::size_t shared = 0;
  int side = 0;
  for (std::uint32_t i = 0; i < ring.size(); ++i) {
    if (const std::optional<std::uint32_t> at = position(p, ring[i])) {
      if (shared == 2) return false;
      in_p[shared] = *at;
      in_q[shared++] = i;
      continue;
    }
    const int sign = surface_.points.orientation(plane[0], plane[1], plane[2], ring[i]);
    if (sign == 0 || sign * side < 0) return false;
    side = sign;
  }
  return shared < 2 || !adjacent(in_q[0], in_q[1], ring.size()) ||
         adjacent(in_p[0], in_p[1], p.size() == 1 ? 3 : corners(p).size());
}

Box SurfacePatches::box(std::span<const std::uint32_t> places) const {
  Box result;
  for (const std::uint32_t v : places) surface_.points.extend(result, v);
  return result;
}

std::vector<Box> SurfacePatches::triangle_boxes(const Patch& patch) const {
  std::vector<Box> boxes;
  boxes.reserve(patch.size());
  for (std::uint32_t t = patch.first; t < patch.last; ++t) boxes.push_back(box(surface_.triangles[t]));
  return boxes;
}

void SurfacePatches::within(const Patch& patch, const std::function<void(std::uint32_t, std::uint32_t)>& visit) const {
  BoxTree(triangle_boxes(patch)).for_each_pair([&](std::uint32_t t, std::uint32_t u) {
    visit(patch.first + t, patch.first + u);
  });
}

void SurfacePatches::between(const Patch& p, const Patch& q,
                             const std::function<void(std::uint32_t, std::uint32_t)>& visit) const {
  if (p.size() > q.size()) {
    between(q, p, [&](std::uint32_t t, std::uint32_t u) { visit(u, t); });
    return;
  }
  const std::vector<Box> boxes = triangle_boxes(q);
  constexpr std::uint32_t kFew = 64;  // pairs that are looked at faster than a tree is built
  if (p.size() * static_cast<std::uint64_t>(q.size()) <= kFew) {
    for (std::uint32_t t = p.first; t < p.last; ++t) {
      const Box own = box(surface_.triangles[t]);
      for (std::uint32_t u = q.first; u < q.last; ++u) {
        if (own.overlaps(boxes[u - q.first])) visit(t, u);
      }
    }
    return;
  }
  const BoxTree tree(boxes);
  for (std::uint32_t t = p.first; t < p.last; ++t) {
    tree.for_each_overlap(box(surface_.triangles[t]), [&](std::uint32_t u) { visit(t, q.first + u); });
  }
}

void SurfacePatches::for_each_candidate(const std::function<void(std::uint32_t, std::uint32_t)>& visit) const {
  std::vector<Box> boxes;
  boxes.reserve(patches_.size());
  for (const Patch& patch : patches_) {
    boxes.push_back(box(corners(patch)));
    if (!patch.convex) within(patch, visit);
  }
  BoxTree(boxes).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
    const Patch& p = patches_[i];
    const Patch& q = patches_[j];
    if (p.size() == 1 && q.size() == 1) {
      if (surface_.pieces[p.first] != surface_.pieces[q.first]) visit(p.first, q.first);
      return;
    }
    // The plane of the larger one first: that asks for the corners of the smaller.
    const bool ordered = p.size() >= q.size();
    if (!apart(ordered ? p : q, ordered ? q : p) && !apart(ordered ? q : p, ordered ? p : q)) between(p, q, visit);
  });
}

}  // namespace nef

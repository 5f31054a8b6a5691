// SPDX-License-Identifier: Apache-2.0
//
// Vertices at equal points are merged; then each face is cut along the coordinate axis along which it looks largest, or
// along another one if its projection there is no simple polygon. A convex ring is cut as a fan, others by the
// `Triangulator`. Whether a face is planar is tested exactly, by the plane of three corners that are not on one line;
// one that is not is cut again, in an order that does not depend on how its corners are listed.
#include "nef/mesh/surface/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nef/mesh/polygon/triangulate.h"
#include "nef/mesh/vertex_merger.h"

namespace nef {
namespace {

bool names_one_twice(const std::vector<std::uint32_t>& ring) {
  constexpr std::size_t kFew = 8;  // corners that are compared faster than a copy is sorted
  if (ring.size() <= kFew) {
    for (auto v = ring.begin(); v != ring.end(); ++v) {
      if (std::find(v + 1, ring.end(), *v) != ring.end()) return true;
    }
    return false;
  }
  std::vector<std::uint32_t> sorted = ring;
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

// Takes out corners that repeat the one before and sides that are walked out and back at once.
void drop_spikes(std::vector<std::uint32_t>& ring) {
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t v : ring) {
    if (!kept.empty() && kept.back() == v) continue;
    if (kept.size() > 1 && kept[kept.size() - 2] == v) {
      kept.pop_back();
    } else {
      kept.push_back(v);
    }
  }
  // The end meets the beginning.
  std::size_t first = 0;
  std::size_t last = kept.size();
  while (last - first > 1) {
    const bool longer = last - first > 2;
    if (kept[first] == kept[last - 1] || (longer && kept[first] == kept[last - 2])) {
      --last;
    } else if (longer && kept[first + 1] == kept[last - 1]) {
      ++first;
    } else {
      break;
    }
  }
  ring.assign(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.begin() + static_cast<std::ptrdiff_t>(last));
}

bool on_one_line(const MeshPoints& points, const std::vector<std::uint32_t>& ring, const Monitor& monitor) {
  for (std::size_t i = 2; i < ring.size(); ++i) {
    if (!points.collinear(ring[0], ring[1], ring[i], monitor)) return false;
  }
  return true;
}

// Planar, or without area. The ring has no corner twice in a row, and if it is convex, none on a line with the next
// two.
bool is_planar(const MeshPoints& points, const std::vector<std::uint32_t>& ring, bool is_convex,
               const Monitor& monitor) {
  std::size_t k = 2;
  while (!is_convex && k < ring.size() && points.collinear(ring[0], ring[1], ring[k], monitor)) ++k;
  return k + 1 >= ring.size() || points.coplanar(ring[0], ring[1], ring[k], std::span(ring).subspan(k + 1));
}

// True if the first ring comes before the second one, of as many corners, by the first corner where they differ.
bool is_less(const MeshPoints& points, const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin());
  return x != a.end() && points.compare(*x, *y) < 0;
}

// Cuts a ring in no plane, where the surface depends on the cut: the same way wherever the ring begins and whichever
// way it turns, so that a face and its back cancel, and a mesh that is turned over bounds what it did. Of all ways to
// walk along the ring from one of its least corners, the least one is cut.
Triangulator::Cut cut_bent(const MeshPoints& points, Triangulator& triangulator, const std::vector<std::uint32_t>& ring,
                           std::vector<Triangulator::Triangle>& out) {
  const std::uint32_t least = *std::min_element(
      ring.begin(), ring.end(), [&](std::uint32_t a, std::uint32_t b) { return points.compare(a, b) < 0; });
  std::vector<std::uint32_t> best;
  bool is_reversed = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] != least) continue;
    std::vector<std::uint32_t> walk = ring;
    std::rotate(walk.begin(), walk.begin() + static_cast<std::ptrdiff_t>(i), walk.end());
    for (const bool reversed : {false, true}) {
      if (reversed) std::reverse(walk.begin() + 1, walk.end());
      if (!best.empty() && !is_less(points, walk, best)) continue;
      best = walk;
      is_reversed = reversed;
    }
  }
  const std::size_t first = out.size();
  const Triangulator::Cut done = triangulator.cut(best, out);
  for (std::size_t t = first; is_reversed && t < out.size(); ++t) std::swap(out[t][1], out[t][2]);
  return done;
}

// Of all faces that are no triangles.
std::size_t corners_of_polygons(const Mesh& mesh) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (const std::size_t size = mesh.face(f).size(); size > 3) count += size;
  }
  return count;
}

}  // namespace

MeshSurface::MeshSurface(const Mesh& mesh, const Monitor& monitor)
    : MeshSurface(mesh, MeshPoints(mesh.vertices), monitor) {}

MeshSurface::MeshSurface(const Mesh& mesh, MeshPoints at, const Monitor& monitor)
    : points(std::move(at)),
      place(points.are_ordered_by_doubles() ? merge_equal(points.approximate()) : merge_equal(mesh.vertices)),
      defects(mesh.face_count(), FaceDefect::kNone) {
  Triangulator triangulator(points, monitor);
  constexpr std::size_t kFewCorners = 16;
  std::vector<std::uint32_t> ring;
  ring.reserve(kFewCorners);
  // A ring of n corners becomes n - 2 triangles.
  const std::size_t count = mesh.corners.size() - std::min(mesh.corners.size(), 2 * mesh.face_count());
  triangles.reserve(count);
  face_of.reserve(count);
  pieces.reserve(count);
  triangle_begin.reserve(mesh.face_count() + 1);
  planar.reserve(mesh.face_count());
  irregular.reserve(mesh.face_count());
  ring_begin.reserve(mesh.face_count() + 1);
  triangle_begin.push_back(0);
  ring_begin.push_back(0);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    ring.clear();
    bool bad = false;
    bool in_one_piece = false;
    bool is_flat = true;
    for (const std::uint32_t v : mesh.face(f)) {
      bad = bad || v >= mesh.vertices.size();
      if (!bad) ring.push_back(place[v]);
    }
    const std::size_t named = ring.size();
    irregular.push_back(
        !bad && (named == 3 ? ring[0] == ring[1] || ring[1] == ring[2] || ring[2] == ring[0] : names_one_twice(ring)));
    if (irregular[f]) drop_spikes(ring);
    if (bad) {
      defects[f] = FaceDefect::kBadIndex;
    } else if (named < 3) {
      defects[f] = FaceDefect::kTooFewCorners;
    } else if (ring.size() < 3) {
      defects[f] = FaceDefect::kNoArea;
    } else if (ring.size() == 3) {
      if (points.collinear(ring[0], ring[1], ring[2], monitor)) {
        defects[f] = FaceDefect::kNoArea;
      } else {
        triangles.push_back({ring[0], ring[1], ring[2]});
      }
    } else {
      const std::size_t first = triangles.size();
      Triangulator::Cut done = triangulator.cut(ring, triangles);
      is_flat = is_planar(points, ring, done == Triangulator::Cut::kConvex, monitor);
      if (!is_flat) {
        triangles.resize(first);
        done = cut_bent(points, triangulator, ring, triangles);
      }
      if (done == Triangulator::Cut::kFailed) {
        defects[f] = on_one_line(points, ring, monitor) ? FaceDefect::kNoArea : FaceDefect::kCrossesItself;
      }
      in_one_piece = done == Triangulator::Cut::kConvex;
    }
    planar.push_back(is_flat);
    if (defects[f] == FaceDefect::kNone && planar[f] && !irregular[f] && ring.size() > 3) {
      if (rings.empty()) rings.reserve(corners_of_polygons(mesh));
      rings.insert(rings.end(), ring.begin(), ring.end());
    }
    ring_begin.push_back(static_cast<std::uint32_t>(rings.size()));
    face_of.resize(triangles.size(), f);
    triangle_begin.push_back(static_cast<std::uint32_t>(triangles.size()));
    const auto first = static_cast<std::uint32_t>(pieces.size());
    while (pieces.size() < triangles.size()) {
      pieces.push_back(in_one_piece ? first : static_cast<std::uint32_t>(pieces.size()));
    }
  }
}

}  // namespace nef

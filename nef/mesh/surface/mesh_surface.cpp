// SPDX-License-Identifier: Apache-2.0
//
// All vertices are sorted along a curve, so that those at equal points lie in one cell of it, where they are merged.
// Then each face is cut along the coordinate axis along which it looks largest, or along another one if its projection
// there is no simple polygon. A convex ring is cut as a fan, others by the `Triangulator`. Whether a face is planar is
// tested exactly, by the plane of three corners that are not on one line; one that is not is cut again, in an order
// that does not depend on how its corners are listed.
#include "nef/mesh/surface/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "nef/base/threads/parallel.h"
#include "nef/mesh/polygon/triangulate.h"

namespace nef {
namespace {

// Writes the smallest vertex at the same point for each vertex of one cell; these come ascending.
void merge_in_cell(std::span<const SpatialKey> cell, const MeshPoints& points, std::vector<std::uint32_t>& place) {
  constexpr std::size_t kFew = 8;  // different points that are compared faster than all are sorted
  std::array<std::uint32_t, kFew> found{};
  std::size_t count = 0;
  for (const SpatialKey& key : cell) {
    const auto equal = [&](std::uint32_t other) { return points.compare(other, key.index) == 0; };
    const auto end = found.begin() + count;
    const auto first = std::find_if(found.begin(), end, equal);
    if (first == end && count == kFew) {
      std::vector<SpatialKey> sorted(cell.begin(), cell.end());
      std::stable_sort(sorted.begin(), sorted.end(),
                       [&](const SpatialKey& a, const SpatialKey& b) { return points.compare(a.index, b.index) < 0; });
      std::uint32_t smallest = sorted[0].index;
      for (const SpatialKey& each : sorted) {
        if (points.compare(smallest, each.index) != 0) smallest = each.index;
        place[each.index] = smallest;
      }
      return;
    }
    if (first == end) found[count++] = key.index;
    place[key.index] = *first;
  }
}

// For each vertex the smallest one at the same point. O(n) where cells are small, O(n log n) at worst.
std::vector<std::uint32_t> merge_along(std::span<const SpatialKey> curve, const MeshPoints& points,
                                       const Monitor& monitor) {
  constexpr std::size_t kBlock = 8192;
  std::vector<std::uint32_t> place(curve.size());
  parallel_for_ranges(curve.size(), kBlock, for_vertices(curve.size(), monitor),
                      [&](std::size_t first, std::size_t last, const Monitor&) {
                        // The cells that begin here.
                        const auto begins = [&](std::size_t i) { return i == 0 || curve[i - 1].cell != curve[i].cell; };
                        std::size_t begin = first;
                        while (begin < last && !begins(begin)) ++begin;
                        while (begin < last) {
                          std::size_t end = begin + 1;
                          while (end < curve.size() && !begins(end)) ++end;
                          merge_in_cell(curve.subspan(begin, end - begin), points, place);
                          begin = end;
                        }
                      });
  return place;
}

bool has_twice(const std::vector<std::uint32_t>& ring) {
  if (ring.size() == 3) return ring[0] == ring[1] || ring[1] == ring[2] || ring[2] == ring[0];
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

// Cuts consecutive faces.
class FaceCutter {
 public:
  FaceCutter(const Mesh& mesh, const MeshPoints& points, std::span<const std::uint32_t> place, const Monitor& monitor)
      : mesh_(mesh), points_(points), place_(place), monitor_(monitor), triangulator_(points, monitor) {
    constexpr std::size_t kFewCorners = 16;
    ring_.reserve(kFewCorners);
  }

  CutFaces cut(std::size_t first, std::size_t last) {
    // A ring of n corners becomes n - 2 triangles.
    const std::size_t corners = mesh_.face_begin[last] - mesh_.face_begin[first];
    out_.reserve(last - first, corners - std::min(corners, 2 * (last - first)), 0);
    last_ = last;
    for (auto f = static_cast<std::uint32_t>(first); f < last; ++f) add(f);
    return std::move(out_);
  }

 private:
  // Of all faces from this one on that are no triangles.
  [[nodiscard]] std::size_t corners_of_polygons(std::size_t f) const {
    std::size_t count = 0;
    for (; f < last_; ++f) {
      if (const std::size_t size = mesh_.face(f).size(); size > 3) count += size;
    }
    return count;
  }

  void add(std::uint32_t f) {
    const std::span<const std::uint32_t> face = mesh_.face(f);
    is_flat_ = true;
    in_one_piece_ = false;
    const bool bad = std::any_of(face.begin(), face.end(), [&](std::uint32_t v) { return v >= place_.size(); });
    ring_.clear();
    for (const std::uint32_t v : bad ? std::span<const std::uint32_t>() : face) ring_.push_back(place_[v]);
    const bool irregular = has_twice(ring_);
    if (irregular) drop_spikes(ring_);
    const FaceDefect defect = bad ? FaceDefect::kBadIndex : face.size() < 3 ? FaceDefect::kTooFewCorners : cut_ring();
    out_.defects.push_back(defect);
    out_.irregular.push_back(irregular);
    out_.planar.push_back(is_flat_);
    if (defect == FaceDefect::kNone && is_flat_ && !irregular && ring_.size() > 3) {
      if (out_.rings.empty()) out_.rings.reserve(corners_of_polygons(f));
      out_.rings.insert(out_.rings.end(), ring_.begin(), ring_.end());
    }
    out_.ring_begin.push_back(static_cast<std::uint32_t>(out_.rings.size()));
    out_.face_of.resize(out_.triangles.size(), f);
    out_.triangle_begin.push_back(static_cast<std::uint32_t>(out_.triangles.size()));
    const auto first = static_cast<std::uint32_t>(out_.pieces.size());
    while (out_.pieces.size() < out_.triangles.size()) {
      out_.pieces.push_back(in_one_piece_ ? first : static_cast<std::uint32_t>(out_.pieces.size()));
    }
  }

  // Into triangles of one face.
  FaceDefect cut_ring() {
    if (ring_.size() < 3) return FaceDefect::kNoArea;
    if (ring_.size() == 3) {
      if (points_.collinear(ring_[0], ring_[1], ring_[2], monitor_)) return FaceDefect::kNoArea;
      out_.triangles.push_back({ring_[0], ring_[1], ring_[2]});
      return FaceDefect::kNone;
    }
    const std::size_t first = out_.triangles.size();
    Triangulator::Cut done = triangulator_.cut(ring_, out_.triangles);
    is_flat_ = is_planar(points_, ring_, done == Triangulator::Cut::kConvex, monitor_);
    if (!is_flat_) {
      out_.triangles.resize(first);
      done = cut_bent(points_, triangulator_, ring_, out_.triangles);
    }
    in_one_piece_ = done == Triangulator::Cut::kConvex;
    if (done != Triangulator::Cut::kFailed) return FaceDefect::kNone;
    return on_one_line(points_, ring_, monitor_) ? FaceDefect::kNoArea : FaceDefect::kCrossesItself;
  }

  const Mesh& mesh_;
  const MeshPoints& points_;
  std::span<const std::uint32_t> place_;
  const Monitor& monitor_;
  Triangulator triangulator_;
  std::size_t last_ = 0;             // behind the faces to cut
  std::vector<std::uint32_t> ring_;  // of the face at hand
  bool is_flat_ = true;
  bool in_one_piece_ = false;
  CutFaces out_;
};

void append_shifted(std::vector<std::uint32_t>& all, std::span<const std::uint32_t> next, std::size_t by) {
  for (const std::uint32_t each : next) all.push_back(each + static_cast<std::uint32_t>(by));
}

}  // namespace

void CutFaces::reserve(std::size_t faces, std::size_t of_triangles, std::size_t ring_corners) {
  triangles.reserve(of_triangles);
  face_of.reserve(of_triangles);
  pieces.reserve(of_triangles);
  triangle_begin.reserve(faces + 1);
  defects.reserve(faces);
  planar.reserve(faces);
  irregular.reserve(faces);
  rings.reserve(ring_corners);
  ring_begin.reserve(faces + 1);
}

void CutFaces::append(const CutFaces& next) {
  append_shifted(triangle_begin, std::span(next.triangle_begin).subspan(1), triangles.size());
  append_shifted(pieces, next.pieces, triangles.size());
  append_shifted(ring_begin, std::span(next.ring_begin).subspan(1), rings.size());
  triangles.insert(triangles.end(), next.triangles.begin(), next.triangles.end());
  face_of.insert(face_of.end(), next.face_of.begin(), next.face_of.end());
  defects.insert(defects.end(), next.defects.begin(), next.defects.end());
  planar.insert(planar.end(), next.planar.begin(), next.planar.end());
  irregular.insert(irregular.end(), next.irregular.begin(), next.irregular.end());
  rings.insert(rings.end(), next.rings.begin(), next.rings.end());
}

MeshSurface::MeshSurface(const Mesh& mesh, const Monitor& monitor)
    : MeshSurface(mesh, MeshPoints(mesh.vertices, monitor), monitor) {}

MeshSurface::MeshSurface(const Mesh& mesh, MeshPoints at, const Monitor& monitor)
    : points(std::move(at)),
      curve(spatial_keys(points.approximate(), monitor)),
      place(merge_along(curve, points, monitor)) {
  constexpr std::size_t kBlock = 8192;
  std::vector<CutFaces> blocks = blocks_of(mesh.face_count(), kBlock, for_vertices(mesh.face_count(), monitor),
                                           [&](std::size_t first, std::size_t last, const Monitor& own) {
                                             return FaceCutter(mesh, points, place, own).cut(first, last);
                                           });
  static_cast<CutFaces&>(*this) = std::move(blocks.front());
  if (blocks.size() == 1) return;
  std::size_t of_triangles = triangles.size();
  std::size_t ring_corners = rings.size();
  for (const CutFaces& block : std::span(blocks).subspan(1)) {
    of_triangles += block.triangles.size();
    ring_corners += block.rings.size();
  }
  reserve(mesh.face_count(), of_triangles, ring_corners);
  for (CutFaces& block : std::span(blocks).subspan(1)) append(std::exchange(block, {}));
}

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/union/visible_faces.h"

#include <algorithm>
#include <cmath>

#include "apps/minkowski/union/face_remains.h"
#include "nef/base/parallel.h"

namespace nef::minkowski {
namespace {

struct Rest {
  std::uint32_t face;
  Box box;
};

bool is_empty(const Box& box) { return !(box.low[0] <= box.high[0]); }

std::vector<std::uint32_t> cells_near(std::uint32_t cell, const Box& box, const BoxTree& boxes) {
  std::vector<std::uint32_t> result;
  boxes.for_each_overlap(box, [&](std::uint32_t other) {
    if (other != cell) result.push_back(other);
  });
  return result;
}

std::vector<Vector> ring_of(std::uint32_t face, const RoundedCells& rounded, const ExactCells& exact) {
  std::vector<Vector> ring;
  for (const std::uint32_t v : exact.corners(face)) ring.push_back(rounded.vertices(rounded.cell_of_face(face))[v]);
  return ring;
}

// Calls visit(cell, filter of its own) for all cells, on several threads.
template <typename Visit>
void for_each_cell(const RoundedCells& rounded, unsigned threads, const Visit& visit) {
  constexpr std::size_t kChunk = 64;
  const FaceRemains prototype(rounded);
  parallel_for((rounded.size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    FaceRemains remains(prototype);
    const std::size_t end = std::min(rounded.size(), (chunk + 1) * kChunk);
    for (std::size_t cell = chunk * kChunk; cell < end; ++cell) visit(static_cast<std::uint32_t>(cell), remains);
  });
}

// The plane of a face on a coarse grid: faces in one plane mostly share it. That they sometimes do not, and that others
// do, costs time only.
std::uint64_t plane_key(const RoundedFace& face, double extent) {
  const Vector& n = face.normal;
  const double size = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
  if (!(size > 0) || !(extent > 0)) return 0;
  const double offset = (n[0] * face.origin[0] + n[1] * face.origin[1] + n[2] * face.origin[2]) / (size * extent);
  std::uint64_t key = 0;
  for (const double x : {n[0] / size, n[1] / size, n[2] / size, offset / 3}) {
    key = key << 16U | (static_cast<std::uint64_t>(std::llround(x * 0x1p14) + 0x8000) & 0xffffU);
  }
  return key;
}

// Finds the exact planes of faces that may be in one plane with a face of another cell.
void find_shared_planes(const RoundedCells& rounded, ExactCells& exact) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(rounded.face_count());
  for (std::uint32_t f = 0; f < rounded.face_count(); ++f) {
    keys.emplace_back(plane_key(rounded.face(f), rounded.extent()), f);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const bool as_before = k > 0 && keys[k - 1].first == keys[k].first;
    const bool as_after = k + 1 < keys.size() && keys[k + 1].first == keys[k].first;
    if (as_before || as_after) exact.plane(keys[k].second);
  }
}

// The faces whose planes are known, plane by plane.
class FacesOfPlanes {
 public:
  FacesOfPlanes(std::size_t face_count, const ExactCells& exact) {
    for (std::uint32_t f = 0; f < face_count; ++f) {
      if (exact.known_plane(f).valid()) faces_.emplace_back(exact.known_plane(f), f);
    }
    std::sort(faces_.begin(), faces_.end());
  }
  // Calls visit(face) for all faces in an oriented plane.
  template <typename Visit>
  void for_each(PlaneId plane, const Visit& visit) const {
    for (auto at = std::lower_bound(faces_.begin(), faces_.end(), std::pair(plane, std::uint32_t{0}));
         at != faces_.end() && at->first == plane; ++at) {
      visit(at->second);
    }
  }

 private:
  std::vector<std::pair<PlaneId, std::uint32_t>> faces_;
};

// Subtracts cells from faces with regard to what is flush.
class FlushCover {
 public:
  FlushCover(std::span<const ConvexCell> cells, const RoundedCells& rounded, const BoxTree& boxes,
             const ExactCells& exact, const PlanesOfCells& planes)
      : cells_(cells),
        rounded_(rounded),
        boxes_(boxes),
        exact_(exact),
        planes_(planes),
        faces_(rounded.face_count(), exact) {}

  // What is left of the faces of a cell.
  [[nodiscard]] std::vector<Rest> rests(std::uint32_t cell, FaceRemains& remains) const {
    std::vector<std::uint32_t> neighbours = cells_near(cell, rounded_.box(cell), boxes_);
    const std::vector<char> covers = covering(cell, neighbours);
    const std::vector<std::uint32_t> flush = flush_faces(cell, covers);
    std::vector<Rest> result;
    for (const std::uint32_t h : flush) remains.ignore(h);
    for (std::uint32_t f = rounded_.first_face(cell); f < rounded_.end_face(cell); ++f) {
      const std::vector<std::uint32_t> absent = yielding_faces(cell, f, covers);
      for (const std::uint32_t h : absent) remains.heed(h);
      const Box box = remains.box_of_rest(ring_of(f, rounded_, exact_), neighbours);
      for (const std::uint32_t h : absent) remains.ignore(h);
      if (!is_empty(box)) result.push_back({f, box});
    }
    for (const std::uint32_t h : flush) remains.heed(h);
    return result;
  }

 private:
  // For every cell: whether it is a neighbour that may cover this one where both are flush.
  [[nodiscard]] std::vector<char> covering(std::uint32_t cell, std::span<const std::uint32_t> neighbours) const {
    std::vector<char> covers(cells_.size(), 0);
    for (const std::uint32_t d : neighbours) covers[d] = d != cell && may_cover(cells_, d, cell, Pyramid::kLarger);
    return covers;
  }

  // Faces of covering cells in planes of faces of this one. Extrusions have thousands of caps in one plane, so that all
  // but the neighbours' are told by a look at a table.
  [[nodiscard]] std::vector<std::uint32_t> flush_faces(std::uint32_t cell, std::span<const char> covers) const {
    std::vector<std::uint32_t> result;
    planes_.for_each(cell, [&](PlaneId plane) {
      faces_.for_each(plane, [&](std::uint32_t h) {
        if (covers[rounded_.cell_of_face(h)] != 0) result.push_back(h);
      });
    });
    return result;
  }

  // Those of the flush faces that are in the plane of face f and whose cells must not cover f, being equal to its cell
  // there and not the ones to stay.
  [[nodiscard]] std::vector<std::uint32_t> yielding_faces(std::uint32_t cell, std::uint32_t f,
                                                          std::span<const char> covers) const {
    std::vector<std::uint32_t> result;
    if (!exact_.known_plane(f).valid()) return result;
    faces_.for_each(exact_.known_plane(f), [&](std::uint32_t h) {
      const std::uint32_t d = rounded_.cell_of_face(h);
      if (covers[d] != 0 && !may_cover(cells_, d, cell, Pyramid::kEqual)) result.push_back(h);
    });
    return result;
  }

  std::span<const ConvexCell> cells_;
  const RoundedCells& rounded_;
  const BoxTree& boxes_;
  const ExactCells& exact_;
  const PlanesOfCells& planes_;
  FacesOfPlanes faces_;
};

}  // namespace

VisibleFaces visible_faces(std::span<const ConvexCell> cells, const RoundedCells& rounded, const BoxTree& boxes,
                           ExactCells& exact, unsigned threads) {
  find_shared_planes(rounded, exact);
  VisibleFaces result;
  result.planes = PlanesOfCells(rounded, exact);
  const FlushCover cover(cells, rounded, boxes, exact, result.planes);
  std::vector<std::vector<Rest>> rests(cells.size());
  for_each_cell(rounded, threads,
                [&](std::uint32_t cell, FaceRemains& remains) { rests[cell] = cover.rests(cell, remains); });
  result.is_visible.assign(rounded.face_count(), 0);
  for (const std::vector<Rest>& faces : rests) {
    if (faces.empty()) ++result.hidden_cells;
    for (const Rest& rest : faces) {
      result.faces.push_back(rest.face);
      result.boxes.push_back(rest.box);
      result.is_visible[rest.face] = 1;
    }
  }
  return result;
}

}  // namespace nef::minkowski

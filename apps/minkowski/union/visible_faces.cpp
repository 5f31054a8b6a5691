// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/union/visible_faces.h"

#include <algorithm>
#include <cmath>

#include "apps/minkowski/union/face_remains.h"
#include "nef/base/threads/parallel.h"

namespace nef::minkowski {
namespace {

struct Rest {
  std::uint32_t face;
  Box box;
};

bool is_empty(const Box& box) { return !(box.low[0] <= box.high[0]); }

std::vector<Double3> ring_of(std::uint32_t face, const RoundedCells& rounded, const ExactCells& exact) {
  std::vector<Double3> ring;
  for (const std::uint32_t v : exact.corners(face)) ring.push_back(rounded.vertices(rounded.cell_of_face(face))[v]);
  return ring;
}

// Calls visit(cell, filter of its own) for all cells, on several threads.
template <typename Visit>
void for_each_cell(const RoundedCells& rounded, const FaceRemains& prototype, const Monitor& monitor,
                   const Visit& visit) {
  constexpr std::size_t kChunk = 64;
  parallel_for((rounded.size() + kChunk - 1) / kChunk, monitor, [&](std::size_t chunk, const Monitor&) {
    FaceRemains remains(prototype);
    const std::size_t end = std::min(rounded.size(), (chunk + 1) * kChunk);
    for (std::size_t cell = chunk * kChunk; cell < end; ++cell) visit(static_cast<std::uint32_t>(cell), remains);
  });
}

// The plane of a face on a coarse grid: faces in one plane mostly share it. That they sometimes do not, and that others
// do, costs time only.
std::uint64_t plane_key(const RoundedFace& face, double extent) {
  const Double3& n = face.normal;
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

// What is left of the faces of a cell.
std::vector<Rest> rests_of(std::uint32_t cell, const RoundedCells& rounded, const ExactCells& exact,
                           FaceRemains& remains) {
  std::vector<Rest> result;
  for (std::uint32_t f = rounded.first_face(cell); f < rounded.end_face(cell); ++f) {
    const Box box = remains.box_of_rest(f, ring_of(f, rounded, exact));
    if (!is_empty(box)) result.push_back({f, box});
  }
  return result;
}

}  // namespace

VisibleFaces visible_faces(std::span<const ConvexCell> cells, const RoundedCells& rounded, const BoxTree& boxes,
                           ExactCells& exact, const Monitor& monitor) {
  find_shared_planes(rounded, exact);
  VisibleFaces result;
  result.planes = PlanesOfCells(rounded, exact);
  const FlushFaces flush(cells, rounded, exact, result.planes);
  std::vector<std::vector<Rest>> rests(cells.size());
  for_each_cell(rounded, FaceRemains(rounded, flush, boxes), monitor, [&](std::uint32_t cell, FaceRemains& remains) {
    rests[cell] = rests_of(cell, rounded, exact, remains);
  });
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

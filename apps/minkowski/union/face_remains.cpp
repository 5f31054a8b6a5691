// SPDX-License-Identifier: Apache-2.0
//
// The polygon is cut along the faces of a cell; the part inside of all of them goes. A cell counts only as far as its
// faces, moved inwards to where the value is inside_, go.
//
// Pieces are closed polygons of rounded points that are neither plane nor convex to the last bit. A cut at which the
// values along the polygon change sign exactly twice makes two polygons which share the cut, run through once in each
// direction: as chains of edges they add up to the one that was cut, so a point that the polygon goes around, in a
// projection along its normal, is gone around by a piece, and lies in the hull of that piece's corners. With more
// changes this is not so; nearly coplanar faces give them by rounding. Then it is not known what the cell takes away,
// and nothing is.
//
// What is left is the drift of cutting points from the edges they are on: a mean of two points of the extent is
// within 2^-50 of the extent, and a piece is cut at most kCuts = 2^16 times, so all of it is below 2^-30 of the extent.
// inside_ allows for that and, twice over, for the error of the values that the cut was computed from.
#include "apps/minkowski/union/face_remains.h"

#include <algorithm>

#include "nef/sphere_map/sphere_map.h"

namespace nef::minkowski {

FaceRemains::FaceRemains(const RoundedCells& cells, const FlushFaces& flush, const BoxTree& boxes)
    : cells_(cells), flush_(flush), boxes_(boxes) {
  inside_.reserve(cells.face_count());
  for (std::uint32_t f = 0; f < cells.face_count(); ++f) {
    inside_.push_back(-4 * cells.face(f).slack - cells.face(f).weight * cells.extent() * 0x1p-30);
  }
  for (std::uint32_t c = 0; c < cells.size(); ++c) beyond_.push_back(cells.first_face(c));
}

Double3 FaceRemains::Polygon::centre() const {
  Double3 sum{};
  for (std::size_t k = 0; k < size; ++k) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += v[k][i];
  }
  for (double& x : sum) x /= static_cast<double>(size);
  return sum;
}

namespace {

bool is_in(const Box& box, const Double3& x) {
  return x[0] >= box.low[0] && x[0] <= box.high[0] && x[1] >= box.low[1] && x[1] <= box.high[1] && x[2] >= box.low[2] &&
         x[2] <= box.high[2];
}

}  // namespace

// Points next to each other are mostly beyond the same face.
bool FaceRemains::has_inside(std::uint32_t cell, const Double3& x) {
  const auto is_beyond = [&](std::uint32_t h) {
    return !(cells_.face(h).value(x) < inside_[h]) && !flush_.may_miss(h, face_);
  };
  if (is_beyond(beyond_[cell])) return false;
  const std::uint32_t end = cells_.end_face(cell);
  for (std::uint32_t h = cells_.first_face(cell); h < end; ++h) {
    if (!is_beyond(h)) continue;
    beyond_[cell] = h;
    return false;
  }
  return true;
}

// A cell that has x inside; kNone if none has. Those that took something away are likely to do so for the next face.
std::uint32_t FaceRemains::cell_around(const Double3& x) {
  const std::uint32_t own = cells_.cell_of_face(face_);
  for (std::size_t k = 0; k < helpful_.size(); ++k) {
    const std::uint32_t cell = helpful_[k];
    if (cell == own || !is_in(cells_.box(cell), x) || !has_inside(cell, x)) continue;
    const auto begin = helpful_.begin();
    std::rotate(begin, begin + static_cast<std::ptrdiff_t>(k), begin + static_cast<std::ptrdiff_t>(k) + 1);
    return cell;
  }
  if (neighbours_of_ != own) {
    neighbours_of_ = own;
    neighbours_.clear();
    boxes_.for_each_overlap(cells_.box(own), [&](std::uint32_t other) {
      if (other != own) neighbours_.push_back(other);
    });
  }
  for (const std::uint32_t cell : neighbours_) {
    if (!is_in(cells_.box(cell), x) || !has_inside(cell, x)) continue;
    constexpr std::size_t kHelpful = 32;
    if (helpful_.size() == kHelpful) helpful_.pop_back();
    helpful_.insert(helpful_.begin(), cell);
    return cell;
  }
  return kNone;
}

// Cuts a polygon by the plane at which values_ are zero; false if that is not one cut from border to border.
bool FaceRemains::cut(const Polygon& polygon, Polygon& inside, Polygon& beyond) const {
  std::size_t changes = 0;
  for (std::size_t k = 0; k < polygon.size; ++k) {
    changes += (values_[k] < 0) != (values_[k + 1 < polygon.size ? k + 1 : 0] < 0) ? 1 : 0;
  }
  if (changes != 2) return false;
  inside.size = beyond.size = 0;
  for (std::size_t k = 0; k < polygon.size; ++k) {
    const std::size_t next = k + 1 < polygon.size ? k + 1 : 0;
    Polygon& here = values_[k] < 0 ? inside : beyond;
    if (!here.push(polygon.v[k])) return false;
    if ((values_[k] < 0) == (values_[next] < 0)) continue;
    const double t = values_[k] / (values_[k] - values_[next]);
    Double3 x{};
    for (std::size_t i = 0; i < 3; ++i) x[i] = polygon.v[k][i] + t * (polygon.v[next][i] - polygon.v[k][i]);
    if (!inside.push(x) || !beyond.push(x)) return false;
  }
  return true;
}

// Leaves in outside_ what is not in the cell; false if the cell takes nothing away, or it is not known what.
bool FaceRemains::subtract(const Polygon& polygon, std::uint32_t cell) {
  outside_.clear();
  Polygon rest = polygon;
  for (std::uint32_t h = cells_.first_face(cell); h < cells_.end_face(cell); ++h) {
    const RoundedFace& face = cells_.face(h);
    bool in = false;
    bool out = false;
    values_.clear();
    for (std::size_t k = 0; k < rest.size; ++k) {
      values_.push_back(face.value(rest.v[k]) - inside_[h]);
      (values_.back() < 0 ? in : out) = true;
    }
    if (!out || flush_.may_miss(h, face_)) continue;
    Polygon inside;
    Polygon beyond;
    if (!in || ++cuts_ > kCuts || !cut(rest, inside, beyond)) return false;
    outside_.push_back(beyond);
    rest = inside;
  }
  return true;
}

Box FaceRemains::box_of_rest(std::uint32_t face, std::span<const Double3> ring) {
  face_ = face;
  cuts_ = 0;
  Box box;
  const double drift = cells_.extent() * 0x1p-30;
  const auto keep = [&](std::span<const Double3> polygon) {
    for (const Double3& x : polygon) {
      for (std::size_t i = 0; i < 3; ++i) {
        box.low[i] = std::min(box.low[i], x[i] - drift);
        box.high[i] = std::max(box.high[i], x[i] + drift);
      }
    }
  };
  if (ring.size() > kCorners) {
    keep(ring);
    return box;
  }
  // Heuristics about time only: a face that keeps something stays as a whole, and looking further would not narrow the
  // box around its rest by much.
  constexpr std::size_t kSubtractions = 64;
  constexpr std::size_t kVisiblePieces = 3;
  std::size_t count = 0;
  std::size_t visible = 0;
  todo_.resize(1);
  std::copy(ring.begin(), ring.end(), todo_[0].v.begin());
  todo_[0].size = ring.size();
  while (!todo_.empty()) {
    const Polygon polygon = todo_.back();
    todo_.pop_back();
    const bool look = count++ < kSubtractions && visible < kVisiblePieces;
    const std::uint32_t cell = look ? cell_around(polygon.centre()) : kNone;
    if (cell != kNone && subtract(polygon, cell)) {
      todo_.insert(todo_.end(), outside_.begin(), outside_.end());
    } else {
      ++visible;
      keep({polygon.v.data(), polygon.size});
    }
  }
  return box;
}

}  // namespace nef::minkowski

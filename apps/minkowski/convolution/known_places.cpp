// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/known_places.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace nef::minkowski {

const FacetAtPoint* KnownPoint::find(std::uint32_t facet) const {
  const auto at = std::lower_bound(facets.begin(), facets.end(), facet,
                                   [](const FacetAtPoint& x, std::uint32_t y) { return x.facet < y; });
  return at != facets.end() && at->facet == facet ? &*at : nullptr;
}

PlacesOfPoints::PlacesOfPoints(double extent) : size_(std::ldexp(extent, -24)) {}

void PlacesOfPoints::add(const Double3& place, std::uint32_t point) { points_[key_of(place)].push_back(point); }

std::span<const std::uint32_t> PlacesOfPoints::near(const Box& box) const {
  const std::uint64_t key = key_of(box.low);
  if (key != key_of(box.high)) return {};
  const auto found = points_.find(key);
  return found == points_.end() ? std::span<const std::uint32_t>() : found->second;
}

// Different cells may have the same key. The cells are numbered by doubles: where they are rounded, and beyond all
// bounds (a segment without an estimate of where it ends), points share a cell, which is allowed.
std::uint64_t PlacesOfPoints::key_of(const Double3& place) const {
  std::uint64_t key = 0;
  for (const double x : place) {
    const double cell = std::floor(x / size_) + 0.0;  // never -0
    key = (key ^ (key >> 29U)) * 0x9e3779b97f4a7c15ULL + std::bit_cast<std::uint64_t>(cell);
  }
  return key;
}

void KnownLines::add(KnownLine line) {
  for (const std::uint32_t f : line.along) along_[f].push_back(static_cast<std::uint32_t>(lines_.size()));
  lines_.push_back(std::move(line));
}

void KnownLines::add_along(KnownLine& line, std::uint32_t facet) {
  line.along.push_back(facet);
  along_[facet].push_back(static_cast<std::uint32_t>(&line - lines_.data()));
}

KnownLine* KnownLines::find(std::uint32_t f, std::uint32_t g, const Box& box) {
  const auto found = along_.find(f);
  if (found == along_.end()) return nullptr;
  for (const std::uint32_t i : found->second) {
    KnownLine& line = lines_[i];
    bool holds = std::find(line.along.begin(), line.along.end(), g) != line.along.end();
    for (std::size_t k = 0; k < 3; ++k) {
      holds = holds && line.box.low[k] <= box.low[k] && box.high[k] <= line.box.high[k];
    }
    if (holds) return &line;
  }
  return nullptr;
}

}  // namespace nef::minkowski

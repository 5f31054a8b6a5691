// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/known_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nef::minkowski {

PlacesOfPoints::PlacesOfPoints(double extent) : size_(std::ldexp(extent, -24)) {}

void PlacesOfPoints::add(const Double3& place, std::uint32_t point) { points_[key_of(place)].push_back(point); }

std::span<const std::uint32_t> PlacesOfPoints::near(const Box& box) const {
  const std::uint64_t key = key_of(box.low);
  if (key != key_of(box.high)) return {};
  const auto found = points_.find(key);
  return found == points_.end() ? std::span<const std::uint32_t>() : found->second;
}

// Coordinates are at most 2^24 cells or little more. Different cells may have the same key.
std::uint64_t PlacesOfPoints::key_of(const Double3& place) const {
  std::uint64_t key = 0;
  for (const double x : place) {
    const auto cell = static_cast<std::int64_t>(std::floor(x / size_));
    key = (key ^ (key >> 29U)) * 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(cell);
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

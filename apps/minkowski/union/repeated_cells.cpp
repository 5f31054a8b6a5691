// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/union/repeated_cells.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace nef::minkowski {
namespace {

// A key that equal cells share, whatever the order of their vertices.
std::uint64_t vertex_hash(std::span<const Double3> vertices) {
  std::uint64_t sum = vertices.size();
  for (const Double3& v : vertices) {
    std::uint64_t h = 0;
    // Adding 0 makes one of the two zeros.
    for (const double x : v) h = (h ^ (h >> 31U) ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15ULL;
    sum += h ^ (h >> 29U);
  }
  return sum;
}

}  // namespace

std::vector<bool> repeated_cells(std::span<const ConvexCell> cells, const RoundedCells& rounded) {
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> seen;
  std::vector<bool> result(cells.size(), false);
  const auto sorted = [&](std::uint32_t i) {
    std::vector<Rational3> vertices = cells[i].mesh.vertices;
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    std::vector<std::uint32_t>& same = seen[vertex_hash(rounded.vertices(i))];
    result[i] = std::any_of(same.begin(), same.end(), [&](std::uint32_t j) {
      return cells[i].boundary == cells[j].boundary && cells[i].boundary != ConvexCell::Boundary::kMixed &&
             sorted(i) == sorted(j);
    });
    if (!result[i]) same.push_back(i);
  }
  return result;
}

}  // namespace nef::minkowski

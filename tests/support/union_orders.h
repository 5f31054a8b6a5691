// SPDX-License-Identifier: Apache-2.0
//
// Unions of sums of cells, two sets at a time, in the orders that the thesis compares (section 10.3, table 10.1): the
// plain twin of what the library does with many cells at once, and what the benchmark of that table runs.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/minkowski/convex/convex_cell.h"
#include "apps/minkowski/minkowski.h"
#include "nef/polyhedron.h"

namespace nef::test {

enum class UnionOrder : std::uint8_t {
  kTrivial,  ///< one after the other onto one growing result
  kQueue,    ///< always the two oldest
  kPriority  ///< always the two smallest, by number of vertices
};

inline constexpr std::array<std::pair<std::string_view, UnionOrder>, 3> kUnionOrders{
    {{"trivial", UnionOrder::kTrivial}, {"queue", UnionOrder::kQueue}, {"priority", UnionOrder::kPriority}}};

/// The sums of all pairs of cells of two bounded sets, as sets.
inline std::vector<Polyhedron> sums_of_cells(const Polyhedron& a, const Polyhedron& b) {
  const std::vector<minkowski::ConvexCell> of_b = minkowski::decompose(b);
  std::vector<Polyhedron> sums;
  for (const minkowski::ConvexCell& c : minkowski::decompose(a)) {
    for (const minkowski::ConvexCell& d : of_b) sums.push_back(to_polyhedron(convex_sum(c, d)));
  }
  return sums;
}

/// The union of all pieces.
inline Polyhedron united(std::vector<Polyhedron> pieces, UnionOrder order) {
  std::deque<Polyhedron> waiting(pieces.begin(), pieces.end());
  const auto smaller = [](const Polyhedron& p, const Polyhedron& q) {
    return p.complex().vertex_count() < q.complex().vertex_count();
  };
  while (waiting.size() > 1) {
    if (order == UnionOrder::kPriority) std::partial_sort(waiting.begin(), waiting.begin() + 2, waiting.end(), smaller);
    Polyhedron sum = unite(waiting[0], waiting[1]);
    waiting.pop_front();
    waiting.pop_front();
    if (order == UnionOrder::kTrivial) {
      waiting.push_front(std::move(sum));
    } else {
      waiting.push_back(std::move(sum));
    }
  }
  return waiting.empty() ? Polyhedron() : waiting.front();
}

}  // namespace nef::test

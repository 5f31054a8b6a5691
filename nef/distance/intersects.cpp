// SPDX-License-Identifier: Apache-2.0
//
// What questions have in common is in meeting_sets.h, how one is answered in meeting_search.cpp. Here are the answers
// that need no search: sets that are empty, unbounded or far from each other, and pairs that crossed lately.
#include "nef/distance/intersects.h"

#include <algorithm>

#include "nef/complex/item_boxes.h"
#include "nef/distance/meeting_search.h"
#include "nef/distance/meeting_sets.h"
#include "nef/polyhedron.h"

namespace nef {

IntersectionQuery::IntersectionQuery(const Polyhedron& a, const Polyhedron& b)
    : sets_(std::make_shared<const MeetingSets>(a, b)) {}

bool IntersectionQuery::meet(const Rational3& translation, const Monitor& monitor) const {
  const auto& [a, b] = sets_->sets;
  if (a.is_empty() || b.is_empty()) return false;
  if (sets_->sides.empty()) {
    return !intersect(a, transform(b, AffineMap::translate(translation), monitor), monitor).is_empty();
  }
  return nef::meet(*sets_, translation, monitor);
}

std::optional<std::vector<std::array<ItemRef, 2>>> IntersectionQuery::contacts(const Rational3& translation,
                                                                               const Monitor& monitor) const {
  const auto& [a, b] = sets_->sets;
  NEF_ASSERT(a.is_bounded() && b.is_bounded());
  if (sets_->sides.empty()) return std::vector<std::array<ItemRef, 2>>{};
  return nef::contacts(*sets_, translation, monitor);
}

// Whether an edge of side x surely crosses the inside of a facet of the other one. In builds without fast paths, too:
// what it leaves out of a sum is named by nothing, and names decide the order of vertices.
bool IntersectionQuery::surely_cross(const Approximation3& translation, Crossings& recent, bool search) const {
  if (sets_->sides.empty()) return false;
  const std::array<Approximation3, 2> shift = {Approximation3{-translation[0], -translation[1], -translation[2]},
                                               translation};
  const auto crosses = [&](const Crossings::Pair& pair) {
    const MeetingSide& own = *sets_->sides[pair.of_edge];
    const EdgeEnds& edge = own.edges[pair.edge];
    return sets_->sides[1 - pair.of_edge]->filter->ask(
               FacetId{pair.facet}, moved_by(own.filter->point(edge.from), shift[pair.of_edge]),
               moved_by(own.filter->point(edge.to), shift[pair.of_edge])) == EdgeCrossing::kCrosses;
  };
  std::vector<Crossings::Pair>& pairs = recent.pairs_;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!crosses(pairs[i])) continue;
    std::rotate(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(i),
                pairs.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    return true;
  }
  bool found = false;
  for (std::uint32_t x = 0; x < 2 && search && !found; ++x) {
    // An edge that crosses the facet at all of the translations does so at this one, where their boxes meet, then.
    const std::array<double, 3> by = {shift[x][0].value, shift[x][1].value, shift[x][2].value};
    const MeetingSide& own = *sets_->sides[x];
    const MeetingSide& other = *sets_->sides[1 - x];
    for_each_near_pair(own, by, other, [&](std::uint32_t e, std::uint32_t f) {
      const Crossings::Pair pair{x, e, f};
      found = crosses(pair);
      if (!found) return true;
      constexpr std::size_t kKept = 8;
      if (pairs.size() == kKept) pairs.pop_back();
      pairs.insert(pairs.begin(), pair);
      return false;
    });
  }
  return found;
}

bool intersects(const Polyhedron& a, const Polyhedron& b, const Rational3& translation, const Monitor& monitor) {
  // One question of sets that are far from each other takes no trees.
  if (a.is_bounded() && b.is_bounded()) {
    std::array<double, 3> by{};
    for (std::size_t i = 0; i < 3; ++i) by[i] = nearest_double(translation[i]);
    if (!shifted(vertices_box(b.complex()), by).overlaps(vertices_box(a.complex()))) return false;
  }
  return IntersectionQuery(a, b).meet(translation, monitor);
}

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/surface/vertex_stars.h"

#include <algorithm>

namespace nef {

VertexStars::VertexStars(const MeshPoints& points, std::span<const Triangle> triangles)
    : points_(points), begin_(points.size() + 1, 0), wedges_(3 * triangles.size()), flat_(points.size(), 0) {
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) ++begin_[v + 1];
  }
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  std::vector<Turns> turns;
  turns.reserve(triangles.size());
  std::vector<std::uint32_t> at(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    for (std::size_t k = 0; k < 3; ++k) wedges_[at[t[k]]++] = {i, t[(k + 1) % 3], t[(k + 2) % 3]};
    turns.push_back(points.filtered_turns(t[0], t[1], t[2]));
  }
  for (std::uint32_t v = 0; v < flat_.size(); ++v) {
    if (!is_closed(star(v))) {
      all_closed_ = false;
    } else if (is_flat(v, star(v), turns)) {
      flat_[v] = 1;
    }
  }
}

bool VertexStars::is_closed(std::span<const Wedge> star) {
  constexpr std::size_t kFew = 16;  // edges that are compared with each other
  if (star.size() > kFew) return is_closed_wide(star);
  for (std::size_t i = 0; i < star.size(); ++i) {
    unsigned departures = 0;  // counted without branches, which nobody could foresee
    unsigned arrivals = 0;
    unsigned turned_over = 0;  // triangles of the same corners
    for (const Wedge& other : star) {
      const auto arrives = static_cast<unsigned>(other.to == star[i].from);
      departures += static_cast<unsigned>(other.from == star[i].from);
      arrivals += arrives;
      turned_over += arrives & static_cast<unsigned>(other.from == star[i].to);
    }
    if (departures != 1 || arrivals != 1 || turned_over != 0) return false;
  }
  return true;
}

// The same by sorting.
bool VertexStars::is_closed_wide(std::span<const Wedge> star) {
  std::vector<Wedge> by_from(star.begin(), star.end());
  std::vector<Wedge> by_to = by_from;
  std::sort(by_from.begin(), by_from.end(), [](const Wedge& a, const Wedge& b) { return a.from < b.from; });
  std::sort(by_to.begin(), by_to.end(), [](const Wedge& a, const Wedge& b) { return a.to < b.to; });
  for (std::size_t i = 0; i < star.size(); ++i) {
    if (by_from[i].from != by_to[i].to || by_from[i].to == by_to[i].from) return false;
    if (i > 0 && by_from[i].from == by_from[i - 1].from) return false;
  }
  return true;
}

bool VertexStars::is_flat(std::uint32_t vertex, std::span<const Wedge> star, std::span<const Turns> turns) const {
  if (star.empty()) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int8_t turn = turns[star[0].triangle][axis];
    if (turn == 0) continue;
    const bool alike = std::all_of(star.begin() + 1, star.end(),
                                   [&](const Wedge& wedge) { return turns[wedge.triangle][axis] == turn; });
    if (alike && times_around(vertex, star, axis, turn > 0) == 1) return true;
  }
  return false;
}

// The number of wedges, each with its first border and without its last one, that hold the direction of the next axis.
// Going counterclockwise, such a wedge comes from at or below that axis to above it, as it is less than half a turn.
std::size_t VertexStars::times_around(std::uint32_t vertex, std::span<const Wedge> star, std::size_t axis,
                                      bool counterclockwise) const {
  const std::size_t height = (axis + 2) % 3;
  std::size_t count = 0;
  for (const Wedge& wedge : star) {
    const std::uint32_t first = counterclockwise ? wedge.from : wedge.to;
    const std::uint32_t last = counterclockwise ? wedge.to : wedge.from;
    if (points_.compare(first, vertex, height) <= 0 && points_.compare(last, vertex, height) > 0) ++count;
  }
  return count;
}

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/surface/vertex_stars.h"

#include <algorithm>

#include "nef/base/threads/group_by.h"
#include "nef/base/threads/parallel.h"

namespace nef {

VertexStars::VertexStars(const MeshPoints& points, std::span<const Triangle> triangles, const Monitor& monitor)
    : points_(points), wedges_(3 * triangles.size()), across_(3 * triangles.size(), kNone), flat_(points.size(), 0) {
  constexpr std::size_t kBlock = 4096;
  const Monitor own = for_vertices(triangles.size(), monitor);
  const auto each_corner = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      for (std::uint32_t k = 0; k < 3; ++k) visit(triangles[i][k], i, k);
    }
  };
  const auto put = [&](std::uint32_t place, std::uint32_t i, std::uint32_t k) {
    wedges_[place] = {i, k, triangles[i][(k + 1) % 3], triangles[i][(k + 2) % 3]};
  };
  begin_ = group_by(points.size(), each_corner, put, own);
  views_ = vector_of(triangles.size(), own, [&](std::size_t i) { return views_of(triangles[i]); });
  const auto close_all = [&](std::size_t first, std::size_t last, const Monitor&) {
    std::vector<std::uint32_t> open;
    for (auto v = static_cast<std::uint32_t>(first); v < last; ++v) {
      if (!close(star(v))) {
        open.push_back(v);
      } else if (is_flat(v, star(v))) {
        flat_[v] = 1;
      }
    }
    return open;
  };
  // The sides that leave such a vertex and those that arrive there.
  for (const std::vector<std::uint32_t>& of_block : blocks_of(flat_.size(), kBlock, own, close_all)) {
    all_closed_ = all_closed_ && of_block.empty();
    for (const std::uint32_t v : of_block) {
      for (const Wedge& wedge : star(v)) {
        across_[3 * wedge.triangle + wedge.corner] = kNone;
        across_[3 * wedge.triangle + (wedge.corner == 0 ? 2 : wedge.corner - 1)] = kNone;
      }
    }
  }
}

std::uint8_t VertexStars::views_of(const Triangle& t) const {
  unsigned views = 0;
  for (unsigned axis = 0; const std::int8_t turn : points_.filtered_turns(t[0], t[1], t[2])) {
    views |= (static_cast<unsigned>(turn > 0) | static_cast<unsigned>(turn < 0) << 1U) << axis;
    axis += 2;
  }
  return static_cast<std::uint8_t>(views);
}

// True if the vertex is closed; then says what is across the sides that leave it.
bool VertexStars::close(std::span<const Wedge> star) {
  constexpr std::size_t kFew = 16;  // edges that are compared with each other
  if (star.size() > kFew) return close_wide(star);
  for (const Wedge& wedge : star) {
    unsigned departures = 0;  // counted without branches, which nobody could foresee
    unsigned arrivals = 0;
    unsigned turned_over = 0;  // triangles of the same corners
    std::uint32_t across = 0;
    for (const Wedge& other : star) {
      const auto arrives = static_cast<unsigned>(other.to == wedge.from);
      departures += static_cast<unsigned>(other.from == wedge.from);
      arrivals += arrives;
      turned_over += arrives & static_cast<unsigned>(other.from == wedge.to);
      across |= other.triangle & (0U - arrives);
    }
    if (departures != 1 || arrivals != 1 || turned_over != 0) return false;
    across_[3 * wedge.triangle + wedge.corner] = across;
  }
  return true;
}

// The same by sorting.
bool VertexStars::close_wide(std::span<const Wedge> star) {
  std::vector<Wedge> by_from(star.begin(), star.end());
  std::vector<Wedge> by_to = by_from;
  std::sort(by_from.begin(), by_from.end(), [](const Wedge& a, const Wedge& b) { return a.from < b.from; });
  std::sort(by_to.begin(), by_to.end(), [](const Wedge& a, const Wedge& b) { return a.to < b.to; });
  for (std::size_t i = 0; i < star.size(); ++i) {
    if (by_from[i].from != by_to[i].to || by_from[i].to == by_to[i].from) return false;
    if (i > 0 && by_from[i].from == by_from[i - 1].from) return false;
    across_[3 * by_from[i].triangle + by_from[i].corner] = by_to[i].triangle;
  }
  return true;
}

bool VertexStars::is_flat(std::uint32_t vertex, std::span<const Wedge> star) const {
  if (star.empty()) return false;
  unsigned views = kAllViews;
  for (const Wedge& wedge : star) views &= views_[wedge.triangle];
  for (unsigned view = 0; view < 6; ++view) {
    if ((views >> view & 1U) != 0 && times_around(vertex, star, view / 2, view % 2 == 0) == 1) return true;
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

// SPDX-License-Identifier: Apache-2.0
//
// Triangles are linked across their sides. Each one that is left, in their order, grows by its neighbours: the ring is
// a linked list, and a heap has the sides that a neighbour may be taken in across, since only the sides beside a
// triangle that was taken in change their answer.
#include "apps/minkowski/convolution/facets/convex_pieces.h"

#include <algorithm>
#include <iterator>

#include "nef/base/error.h"
#include "nef/mesh/edge_order.h"

namespace nef::minkowski {

// Or goes straight on; not back, as where a facet goes around an edge that ends inside of it.
bool ConvexPieces::turns_left(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
  const int turn = sign_ * points_.orientation_along(a, b, c, axis_, monitor_);
  return turn > 0 || (turn == 0 && points_.compare(a, b) == points_.compare(b, c));
}

bool ConvexPieces::is_convex(const Ring& ring) const {
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!turns_left(ring[i], ring[(i + 1) % n], ring[(i + 2) % n])) return false;
  }
  return true;
}

// Remembers the edges that have the facet on both sides.
void ConvexPieces::find_slits(const std::vector<Ring>& rings) {
  sides_.clear();
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) sides_.insert(pair_key(ring[i], ring[(i + 1) % ring.size()]));
  }
}

bool ConvexPieces::is_slit(std::uint32_t u, std::uint32_t v) const {
  return sides_.count(pair_key(u, v)) > 0 && sides_.count(pair_key(v, u)) > 0;
}

// The corners of all triangles as a linked list for each, and for the side after a corner the one across it.
void ConvexPieces::link(const std::vector<Triangulator::Triangle>& triangles) {
  corners_.clear();
  std::vector<Side> sides;
  for (const Triangulator::Triangle& t : triangles) {
    const auto first = static_cast<std::uint32_t>(corners_.size());
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners_.push_back({t[k], first + (k + 2) % 3, first + (k + 1) % 3, kNone});
      sides.push_back({edge_key(t[k], t[(k + 1) % 3]), first + k});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.key != b.key ? a.key < b.key : a.corner < b.corner; });
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].key != sides[i - 1].key) continue;
    Corner& one = corners_[sides[i - 1].corner];
    Corner& other = corners_[sides[i].corner];
    if (one.vertex == other.vertex || one.across != kNone || is_slit(one.vertex, other.vertex)) continue;
    one.across = sides[i].corner;
    other.across = sides[i - 1].corner;
  }
}

// Takes the triangle across the side after a corner into the ring, if the result is convex. The corner then leads to
// the triangle's third one.
bool ConvexPieces::merge(std::uint32_t corner) {
  Corner& a = corners_[corner];
  const std::uint32_t of_b = a.next;
  Corner& b = corners_[of_b];
  Corner& third = corners_[corners_[a.across].prev];
  const bool convex = turns_left(corners_[a.prev].vertex, a.vertex, third.vertex) &&
                      turns_left(third.vertex, b.vertex, corners_[b.next].vertex);
  if (!convex) return false;
  // The triangle runs from b to a, to its third corner and back. Its corner at a becomes what a was before.
  const std::uint32_t of_third = corners_[a.across].prev;
  a.across = corners_[corners_[a.across].next].across;
  a.next = of_third;
  third.prev = corner;
  third.next = of_b;
  b.prev = of_third;
  return true;
}

// The ring of a triangle, after it has taken in others as long as what comes of it is convex: always the first one of
// those that it can.
ConvexPieces::Ring ConvexPieces::grown(std::uint32_t triangle) {
  const auto later = [](const Candidate& x, const Candidate& y) { return x.triangle > y.triangle; };
  const auto look_across = [&](std::uint32_t corner) {
    const std::uint32_t across = corners_[corner].across;
    if (across == kNone || taken_[across / 3]) return;
    candidates_.push_back({across / 3, corner});
    std::push_heap(candidates_.begin(), candidates_.end(), later);
  };
  std::uint32_t start = 3 * triangle;
  taken_[triangle] = true;
  for (std::uint32_t k = 0; k < 3; ++k) look_across(start + k);
  while (!candidates_.empty()) {
    std::pop_heap(candidates_.begin(), candidates_.end(), later);
    const Candidate next = candidates_.back();
    candidates_.pop_back();
    const bool is_there = corners_[next.corner].across != kNone && corners_[next.corner].across / 3 == next.triangle;
    if (!is_there || taken_[next.triangle] || !merge(next.corner)) continue;
    taken_[next.triangle] = true;
    const std::uint32_t third = corners_[next.corner].next;
    start = corners_[third].next;
    // Where the ring turns has changed at both ends of what was a side, and so has the answer for the sides beside it.
    for (const std::uint32_t corner : {corners_[next.corner].prev, next.corner, third, start}) look_across(corner);
  }
  Ring ring;
  std::uint32_t at = start;
  do {
    ring.push_back(corners_[at].vertex);
    at = corners_[at].next;
  } while (at != start);
  return ring;
}

bool ConvexPieces::is_straight(std::span<const std::uint32_t> corners) const {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    if (points_.orientation_along(corners[i - 2], corners[i - 1], corners[i], axis_, monitor_) != 0) return false;
  }
  return true;
}

// Appends a convex ring, or, if it has very many corners, pieces of it: one for the corners in each of many groups, and
// what these leave, and so on. Corners on a side stay with the rest, so that each side ends where its neighbours' do.
void ConvexPieces::append_small(Ring&& ring, std::vector<Ring>& pieces) const {
  constexpr std::size_t kMostCorners = 96;
  constexpr std::size_t kGroup = 32;
  while (ring.size() > kMostCorners) {
    std::vector<Ring> groups;
    Ring rest;
    for (std::size_t from = 0; from < ring.size(); from += kGroup) {
      const std::size_t to = std::min(from + kGroup, ring.size());
      Ring group(ring.begin() + static_cast<std::ptrdiff_t>(from), ring.begin() + static_cast<std::ptrdiff_t>(to));
      group.push_back(ring[to % ring.size()]);
      rest.push_back(group.front());
      if (is_straight(group)) {
        rest.insert(rest.end(), group.begin() + 1, group.end() - 1);
      } else {
        groups.push_back(std::move(group));
      }
    }
    // With three groups that turn, none of them goes back to the line on which it began, and the rest is a polygon.
    if (groups.size() < 3) break;
    std::move(groups.begin(), groups.end(), std::back_inserter(pieces));
    ring = std::move(rest);
  }
  pieces.push_back(std::move(ring));
}

std::vector<std::vector<std::uint32_t>> ConvexPieces::cut(const std::vector<Ring>& rings,
                                                          const ProjectionAxis& projection) {
  axis_ = projection.axis;
  sign_ = projection.sign;
  std::vector<Ring> pieces;
  if (rings.size() == 1 && is_convex(rings[0])) {
    append_small(Ring(rings[0]), pieces);
    return pieces;
  }
  find_slits(rings);
  std::vector<Triangulator::Triangle> triangles;
  const bool done = triangulator_.triangulate(rings, axis_, sign_, triangles);
  NEF_ASSERT(done);
  link(triangles);
  taken_.assign(triangles.size(), false);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (!taken_[t]) append_small(grown(t), pieces);
  }
  return pieces;
}

}  // namespace nef::minkowski

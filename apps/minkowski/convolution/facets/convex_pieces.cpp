// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/convolution/facets/convex_pieces.h"

#include <algorithm>

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

// Takes `other` into `ring` across a side that both have, if the result is convex.
bool ConvexPieces::merge(Ring& ring, const Ring& other) const {
  const std::size_t n = ring.size();
  const std::size_t m = other.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < m; ++j) {
      if (ring[i] != other[(j + 1) % m] || ring[(i + 1) % n] != other[j]) continue;
      if (is_slit(ring[i], other[j])) return false;
      const bool convex = turns_left(ring[(i + n - 1) % n], ring[i], other[(j + 2) % m]) &&
                          turns_left(other[(j + m - 1) % m], other[j], ring[(i + 2) % n]);
      if (!convex) return false;
      Ring merged;
      for (std::size_t k = 1; k <= n; ++k) merged.push_back(ring[(i + k) % n]);
      for (std::size_t k = 2; k < m; ++k) merged.push_back(other[(j + k) % m]);
      ring = std::move(merged);
      return true;
    }
  }
  return false;
}

std::vector<std::vector<std::uint32_t>> ConvexPieces::cut(const std::vector<Ring>& rings,
                                                          const ProjectionAxis& projection) {
  axis_ = projection.axis;
  sign_ = projection.sign;
  if (rings.size() == 1 && is_convex(rings[0])) return rings;
  find_slits(rings);
  std::vector<Triangulator::Triangle> triangles;
  const bool done = triangulator_.triangulate(rings, axis_, sign_, triangles);
  NEF_ASSERT(done);
  std::vector<Ring> pieces;
  for (const Triangulator::Triangle& t : triangles) pieces.emplace_back(t.begin(), t.end());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = i + 1; j < pieces.size();) {
      if (!merge(pieces[i], pieces[j])) {
        ++j;
        continue;
      }
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;
    }
  }
  return pieces;
}

}  // namespace nef::minkowski

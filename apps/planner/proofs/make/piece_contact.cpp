// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/proofs/make/piece_contact.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "apps/planner/intersection/common_point.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

bool boxes_touch(std::span<const Rational3> p, std::span<const Rational3> q) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto less = [k](const Rational3& a, const Rational3& b) { return a[k] < b[k]; };
    const auto [p_low, p_high] = std::minmax_element(p.begin(), p.end(), less);
    const auto [q_low, q_high] = std::minmax_element(q.begin(), q.end(), less);
    if ((*p_high)[k] < (*q_low)[k] || (*q_high)[k] < (*p_low)[k]) return false;
  }
  return true;
}

}  // namespace

std::optional<BlockingContact> contact_of_pieces(std::span<const Rational3> first, std::span<const Rational3> second) {
  if (!boxes_touch(first, second)) return std::nullopt;
  HullWitness found = witness_of_hulls(first, second, false);
  if (!found.common) return std::nullopt;
  Rational3 at;
  for (std::size_t v = 0; v < first.size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) at[k] += found.common->robot[v] * first[v][k];
  }
  std::vector<Rational3> rays;
  for (const Rational3& y : second) rays.push_back(minus(y, at));
  for (const Rational3& x : first) rays.push_back(minus(at, x));
  OpenCone blocked = inside_of_hull(rays);
  if (blocked.empty()) return std::nullopt;
  return BlockingContact{std::move(*found.common), std::move(blocked)};
}

std::size_t widest_edge(const ConeCorners& corners) {
  // Minus the cosine.
  const auto spread = [&](std::size_t k) { return -direction_of(corners[k]).dot(direction_of(corners[(k + 1) % 3])); };
  std::size_t edge = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (spread(k) > spread(edge)) edge = k;
  }
  return edge;
}

ConeCorners half_cone(const ConeCorners& corners, std::size_t edge, std::size_t replaced) {
  ConeCorners half = corners;
  half[replaced] = plus(corners[edge], corners[(edge + 1) % 3]);
  return half;
}

}  // namespace nef::planner

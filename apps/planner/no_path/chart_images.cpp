// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/no_path/chart_images.h"

#include <algorithm>
#include <utility>

#include "nef/base/threads/parallel.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

// A quaternion that is 1, i, j or k, or the opposite of one of these.
struct SignedUnit {
  std::uint32_t unit = 0;
  int sign = 1;
};

SignedUnit unit_product(std::uint32_t a, std::uint32_t b) {
  if (a == 0) return {b, 1};
  if (b == 0) return {a, 1};
  if (a == b) return {0, -1};
  const std::uint32_t other = 6 - a - b;  // i j = k, and so on round
  return {other, b == a % 3 + 1 ? 1 : -1};
}

Rational3 turned_by_half(const Rational3& v, std::uint32_t axis) {
  Rational3 result{-v[0], -v[1], -v[2]};
  result[axis] = v[axis];
  return result;
}

// For each piece the one onto which a half turn takes it; nothing if there is none for some.
std::optional<std::vector<std::uint32_t>> pieces_after_half_turn(const std::vector<std::vector<Rational3>>& pieces,
                                                                 std::uint32_t axis, const Monitor& monitor) {
  std::vector<std::uint32_t> result;
  for (const std::vector<Rational3>& piece : pieces) {
    monitor.check_interruption();
    std::vector<Rational3> turned;
    for (const Rational3& v : piece) turned.push_back(turned_by_half(v, axis));
    std::sort(turned.begin(), turned.end());
    const auto found = std::find(pieces.begin(), pieces.end(), turned);
    if (found == pieces.end()) return std::nullopt;
    result.push_back(static_cast<std::uint32_t>(found - pieces.begin()));
  }
  return result;
}

}  // namespace

std::vector<std::optional<ChartImage>> images_of_charts(const PathProof::Claim& claim, const Orientations& orientations,
                                                        const Rational3& reference, const Monitor& monitor) {
  std::vector<std::vector<Rational3>> pieces;  // seen from the reference point, sorted
  for (const std::vector<Rational3>& piece : claim.robot) {
    std::vector<Rational3>& seen = pieces.emplace_back();
    for (const Rational3& v : piece) seen.push_back(minus(v, reference));
    std::sort(seen.begin(), seen.end());
  }
  std::array<std::optional<std::vector<std::uint32_t>>, 3> half_turns;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const bool keeps_origin = turned_by_half(reference, axis) == reference;
    if (keeps_origin || !claim.box) half_turns[axis] = pieces_after_half_turn(pieces, axis, monitor);
  }
  std::vector<std::optional<ChartImage>> result(orientations.charts().size());
  for (std::uint32_t chart = 1; chart < result.size(); ++chart) {
    for (std::uint32_t of = 0; of < chart && !result[chart]; ++of) {
      const std::uint32_t u = unit_product(of, chart).unit;  // e_of u is e_chart or its opposite
      if (result[of] || !half_turns[u - 1]) continue;
      ChartImage& image = result[chart].emplace();
      image.of = of;
      image.pieces = *half_turns[u - 1];
      const int sign = unit_product(of, u).sign;
      for (std::uint32_t component = 0; component < 4; ++component) {
        if (component == of) continue;
        const SignedUnit there = unit_product(component, u);
        const std::uint32_t parameter = Orientations::parameter_of(of, component);
        image.becomes[parameter] = Orientations::parameter_of(chart, there.unit);
        image.signs[parameter] = sign * there.sign;
      }
    }
  }
  return result;
}

namespace {

// `levels`: how often both halves of a box are made at once.
PathProof::PoseCell image_of(const PathProof::PoseCell& cell, const ChartImage& image, unsigned levels,
                             const Monitor& monitor) {
  PathProof::PoseCell result;
  result.kind = cell.kind;
  result.axis = cell.axis;
  result.at = cell.at;
  result.obstacle = cell.obstacle;
  result.common = cell.common;
  result.drift = cell.drift;
  for (std::size_t k = 0; k < cell.drift.size(); ++k) {
    result.drift[image.becomes[k]] = image.signs[k] < 0 ? opposite(cell.drift[k]) : cell.drift[k];
  }
  result.side = cell.side;
  result.halves.resize(cell.halves.size());
  const auto make_half = [&](std::size_t i, const Monitor& own) {
    result.halves[i] = image_of(cell.halves[i], image, levels == 0 ? 0 : levels - 1, own);
  };
  if (levels > 0 && cell.halves.size() == 2) {
    parallel_calls(monitor,
                   {[&](const Monitor& own) { make_half(0, own); }, [&](const Monitor& own) { make_half(1, own); }});
  } else {
    for (std::size_t i = 0; i < cell.halves.size(); ++i) make_half(i, monitor);
  }
  if (cell.kind == PathProof::PoseCell::Kind::kBlocked) result.robot = image.pieces[cell.robot];
  if (cell.kind == PathProof::PoseCell::Kind::kCut && cell.axis >= 3) {
    result.axis = 3 + image.becomes[cell.axis - 3];
    if (image.signs[cell.axis - 3] < 0) {
      result.at = -cell.at;
      std::swap(result.halves[0], result.halves[1]);
    }
  }
  return result;
}

}  // namespace

PathProof::PoseCell image_of(const PathProof::PoseCell& cell, const ChartImage& image, const Monitor& monitor) {
  constexpr unsigned kLevels = 6;  // trees are not balanced
  return image_of(cell, image, kLevels, monitor);
}

}  // namespace nef::planner

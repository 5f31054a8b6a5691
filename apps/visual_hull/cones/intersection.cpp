// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/cones/intersection.h"

#include <Eigen/Core>
#include <atomic>
#include <cmath>

#include "nef/base/threads/parallel.h"
#include "nef/polyhedron.h"

namespace nef::visual_hull {
namespace {

// Of length one, or zero.
Eigen::Vector3d unit(const Rational3& axis) {
  const Eigen::Vector3d v(nef::nearest_double(axis[0]), nef::nearest_double(axis[1]), nef::nearest_double(axis[2]));
  return v.stableNormalized();
}

// How much two axes look along each other: 0 for a right angle.
double alignment(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::abs(a.dot(b)); }

// Pairs each part with the one left that looks across it most.
std::vector<Part> pair_across(std::vector<Part> parts) {
  std::vector<Eigen::Vector3d> axes;
  for (const Part& part : parts) axes.push_back(unit(part.axis));
  std::vector<bool> used(parts.size(), false);
  std::vector<Part> ordered;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (used[i]) continue;
    used[i] = true;
    std::size_t best = parts.size();
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      if (!used[j] && (best == parts.size() || alignment(axes[i], axes[j]) < alignment(axes[i], axes[best]))) best = j;
    }
    ordered.push_back(std::move(parts[i]));
    if (best == parts.size()) continue;
    used[best] = true;
    ordered.push_back(std::move(parts[best]));
  }
  return ordered;
}

}  // namespace

nef::Polyhedron intersect_parts(std::vector<Part> parts, const nef::Monitor& monitor) {
  if (parts.empty()) return nef::Polyhedron::everything();
  std::vector<Part> level = pair_across(std::move(parts));
  const std::size_t total = level.size() - 1;
  std::atomic<std::size_t> done = 0;
  while (level.size() > 1) {
    const std::size_t pairs = level.size() / 2;
    std::vector<Part> next(pairs);
    nef::parallel_for(pairs, monitor, [&](std::size_t i, const nef::Monitor& own) {
      next[i] = {nef::intersect(level[2 * i].solid, level[2 * i + 1].solid, own.quiet()), level[2 * i].axis};
      level[2 * i] = {};  // its memory is not needed any more
      level[2 * i + 1] = {};
      own.tell_progress("intersection", ++done, total);
    });
    for (const Part& part : next) {
      if (part.solid.is_empty()) return {};
    }
    if (level.size() % 2 == 1) next.push_back(std::move(level.back()));
    level = std::move(next);
  }
  return std::move(level[0].solid);
}

std::optional<std::size_t> vanishes_at(const std::vector<Part>& parts, const nef::Polyhedron& box, bool solid,
                                       const nef::Monitor& monitor) {
  nef::Polyhedron left = box;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    left = nef::intersect(left, parts[i].solid, monitor);
    if (left.is_empty() || (solid && nef::interior(left, monitor).is_empty())) return i;
  }
  return std::nullopt;
}

}  // namespace nef::visual_hull

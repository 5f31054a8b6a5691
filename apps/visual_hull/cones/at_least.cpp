// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/cones/at_least.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "nef/labeled_polyhedron.h"

namespace nef::visual_hull {

nef::Polyhedron in_at_least(std::span<const nef::Polyhedron> cones, std::size_t least, const nef::Polyhedron& room,
                            const nef::Monitor& monitor) {
  // The label of a point: in how many cones it is, up to `least`; kOut if it cannot be in enough any more.
  constexpr int kOut = -1;
  using Counted = nef::LabeledPolyhedron<int>;
  const int wanted = static_cast<int>(least);
  if (least == 0) return room;
  if (least > cones.size() || room.is_empty()) return {};
  Counted counted(room, kOut, 0);
  int left = static_cast<int>(cones.size());
  for (const nef::Polyhedron& cone : cones) {
    --left;
    const Counted held(cone, 0, 1);
    const auto add = [wanted, left](int count, int more) {
      if (count == kOut) return kOut;
      const int sum = std::min(count + more, wanted);
      return sum + left < wanted ? kOut : sum;
    };
    counted = overlay(counted, held, add, monitor);
  }
  return counted.where([wanted](int count) { return count == wanted; }, monitor);
}

namespace {

// The box around those of groups, of which `group_of` names the one of a cone.
Bounds around_groups(std::span<const std::vector<HalfSpace>> cones, std::size_t groups,
                     const std::function<std::size_t(std::size_t)>& group_of) {
  std::vector<std::vector<HalfSpace>> half_spaces(groups);
  for (std::size_t i = 0; i < cones.size(); ++i) {
    std::vector<HalfSpace>& group = half_spaces[group_of(i)];
    group.insert(group.end(), cones[i].begin(), cones[i].end());
  }
  Bounds all;
  all.kind = Bounds::Kind::kEmpty;
  for (const std::vector<HalfSpace>& group : half_spaces) {
    Bounds bounds = bounds_of(group);
    if (bounds.kind == Bounds::Kind::kUnbounded) return bounds;
    if (bounds.kind == Bounds::Kind::kEmpty) continue;
    if (all.kind == Bounds::Kind::kEmpty) {
      all = bounds;
      continue;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      all.box.low[i] = std::min(all.box.low[i], bounds.box.low[i]);
      all.box.high[i] = std::max(all.box.high[i], bounds.box.high[i]);
    }
  }
  return all;
}

}  // namespace

Bounds bounds_of_at_least(std::span<const std::vector<HalfSpace>> cones, std::size_t least) {
  const std::size_t groups = cones.size() - least + 1;
  // Neighbours of a sequence look in similar directions, so each group takes views from all of it; where the sequence
  // repeats itself, runs of it do better.
  Bounds spread = around_groups(cones, groups, [groups](std::size_t i) { return i % groups; });
  if (spread.kind != Bounds::Kind::kUnbounded) return spread;
  return around_groups(cones, groups, [&](std::size_t i) { return i * groups / cones.size(); });
}

}  // namespace nef::visual_hull

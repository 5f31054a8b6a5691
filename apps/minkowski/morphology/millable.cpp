// SPDX-License-Identifier: Apache-2.0
//
// Where the tool gets without cutting the part (a configuration space within a box), what it covers there (a sum), and
// what of the part's box that leaves. The box of positions holds those at which the tool comes into the part's box; on
// its border the tool is free, so positions are connected to the outside iff they are to a corner within the box. A
// tool that comes from above is as tall as what may be above it: then each free position is one that it gets to.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/morphology.h"
#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/parts/split.h"
#include "nef/polyhedron.h"
#include "nef/query/measure.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef::minkowski {
namespace {

using Corners = std::array<Rational3, 2>;

// Pieces by descending volume as doubles tell it; the first one first where they do not.
std::vector<Polyhedron> regions_of(const Polyhedron& set, const Monitor& monitor) {
  std::vector<std::pair<double, Polyhedron>> pieces;
  for (Polyhedron& piece : split_volumes(set, monitor)) {
    const double volume = approximate_volume(piece, monitor).value;
    pieces.emplace_back(volume, std::move(piece));
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const auto& p, const auto& q) { return p.first > q.first; });
  std::vector<Polyhedron> result;
  for (auto& [volume, piece] : pieces) result.push_back(std::move(piece));
  return result;
}

}  // namespace

Millable millable(const Polyhedron& part, const Polyhedron& tool, Approach approach, const MinkowskiOptions& options,
                  MinkowskiReport* report) {
  require_bounded(part, "the part");
  require_bounded(tool, "the tool");
  const Monitor& monitor = options.monitor;
  const Polyhedron cutter = regularize(tool, monitor);
  if (cutter.is_empty()) throw InputError("the tool has no volume, so it cuts nothing: give a solid");
  if (part.is_empty()) return {};
  const Corners of_part = bounding_box(part, monitor).value();
  const Corners of_tool = bounding_box(cutter, monitor).value();
  Corners room;
  for (std::size_t i = 0; i < 3; ++i) {
    room[0][i] = of_part[0][i] - of_tool[1][i];
    room[1][i] = of_part[1][i] - of_tool[0][i];
  }
  Polyhedron moving = cutter;
  if (approach == Approach::kFromAbove) {
    const std::array<Rational3, 2> up = {Rational3{}, {0, 0, Rational(room[1][2] - room[0][2])}};
    moving = sweep(cutter, up, options, report);
  }
  Polyhedron positions = configuration_space(moving, {&part, 1}, room, options, report);
  if (approach == Approach::kAnywhere) positions = component_of(positions, room[0], monitor);
  const Polyhedron cut = minkowski_sum(positions, cutter, options, report);
  const Polyhedron body = closure(part, monitor);
  Millable result;
  result.shape = regularize(subtract(make_box(of_part[0], of_part[1], monitor), cut, monitor), monitor);
  result.unreached = regions_of(regularize(subtract(result.shape, body, monitor), monitor), monitor);
  // No position that is free covers anything of the inside of the part, so that is in the shape already.
  if (!is_full_dimensional(body)) result.shape = unite(result.shape, body, monitor);
  return result;
}

}  // namespace nef::minkowski

// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/path/path.h"

#include <algorithm>

#include "apps/planner/path/shorten.h"
#include "apps/planner/path/simple_points.h"
#include "apps/planner/search/search.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

void require_junctions(const FreeSpace& free, CellFilter& filter, int dimension, CellId start, CellId goal) {
  for (CellId cell = 0; cell < free.cells().size(); ++cell) {
    if (cell != start && cell != goal && free.cells().dimension(cell) < dimension) filter.forbid(cell);
  }
}

constexpr std::size_t kMilestonesForWayRound = 400;

// Where free space has so many cells, the roadmap costs a tenth of a second or more, and is made only if there is no
// way without it.
constexpr std::size_t kManyCells = 2000;

std::optional<Waypoints> first_path(const FreeSpace& free, const CellFilter& filter, int min_dimension,
                                    const Rational3& start, const Rational3& goal, const PathOptions& options,
                                    const Monitor& monitor) {
  if (free.cells().size() >= kManyCells && !options.raw && !options.clearance) {
    if (std::optional<Waypoints> way = corridor_path(free, filter, min_dimension, start, goal, monitor)) return way;
  }
  return roadmap_path(free, filter, start, goal, options.clearance, monitor);
}

}  // namespace

std::optional<ExactPath> find_path(const FreeSpace& free, const Rational3& start, const Rational3& goal,
                                   const PathOptions& options, const Monitor& monitor) {
  const CellId start_cell = free.locate(ExactPoint(start));
  const CellId goal_cell = free.locate(ExactPoint(goal));
  if (!free.is_free(start_cell) || !free.is_free(goal_cell)) return std::nullopt;
  if (free.component(start_cell) != free.component(goal_cell)) return std::nullopt;
  const std::optional<Thinness> best = options.roomy ? free.thinness(start_cell, goal_cell) : std::nullopt;
  const int min_dimension = std::max(options.min_dimension, best ? best->piece : 0);
  // Thinner cells than wanted are out, whatever they join.
  CellFilter filter(free, min_dimension);
  if (best) require_junctions(free, filter, best->junction, start_cell, goal_cell);
  if (!filter(start_cell) || !filter(goal_cell)) return std::nullopt;
  const Waypoints& known = options.known;
  if (!known.empty() && known.front() == start && known.back() == goal && way_allowed(free, filter, known)) {
    std::optional<ExactPath> path = describe_path(free, known);
    NEF_ASSERT(path.has_value());
    if (options.digits) path->unrounded = unrounded_points(path->points, *options.digits);
    return path;
  }
  std::optional<Waypoints> points = first_path(free, filter, min_dimension, start, goal, options, monitor);
  // T and J need not be had by one and the same path; T counts first.
  if (!points && options.roomy) {
    PathOptions looser = options;
    looser.roomy = false;
    looser.min_dimension = min_dimension;
    return find_path(free, start, goal, looser, monitor);
  }
  if (!points) return std::nullopt;
  const SegmentCheck allowed = [&](const Rational3& a, const Rational3& b) {
    return segment_allowed(free, filter, a, b);
  };
  if (!options.raw) shortcut(free, filter, *points, options.clearance);
  if (!options.raw && !options.clearance) {
    tighten(free, filter, *points, options.thorough ? 40 : 4);
    if (options.thorough) take_shorter_way_round(free, filter, *points, kMilestonesForWayRound);
    straighten(allowed, *points);
  }
  std::vector<std::size_t> unrounded;
  if (options.digits) unrounded = round_points(allowed, *points, *options.digits);
  std::optional<ExactPath> path = describe_path(free, std::move(*points));
  NEF_ASSERT(path.has_value());
  path->unrounded = std::move(unrounded);
  return path;
}

std::vector<double> lengths_of(const ExactPath& path) {
  std::vector<double> lengths;
  for (std::size_t i = 1; i < path.points.size(); ++i) lengths.push_back(distance(path.points[i - 1], path.points[i]));
  return lengths;
}

std::optional<ExactPath> describe_path(const FreeSpace& free, std::vector<Rational3> points) {
  ExactPath path;
  path.thinness = {3, 3};
  const CellId first = free.locate(ExactPoint(points.front()));
  const CellId last = free.locate(ExactPoint(points.back()));
  const auto use = [&](CellId cell) {
    path.thinness.piece = std::min(path.thinness.piece, free.local_dimension(cell));
    if (cell != first && cell != last) {
      path.thinness.junction = std::min(path.thinness.junction, free.cells().dimension(cell));
    }
    const std::optional<std::uint32_t> passage = free.passage_of(cell);
    if (passage && (path.passages.empty() || path.passages.back() != *passage)) path.passages.push_back(*passage);
  };
  if (!free.is_free(first)) return std::nullopt;
  if (points.size() == 1) use(first);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    int runs_in = 3;
    ++path.segments_checked;
    for (const CellOnSegment& on : cells_along(free, points[i], points[i + 1])) {
      if (!free.is_free(on.cell)) return std::nullopt;
      use(on.cell);
      if (!on.is_point) runs_in = std::min(runs_in, free.cells().dimension(on.cell));
    }
    path.segment_dimensions.push_back(runs_in);
    path.length += distance(points[i], points[i + 1]);
  }
  path.points = std::move(points);
  return path;
}

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// Intervals come in the order in which a tree of boxes gives pairs of facets, so those of a run are near each other. On
// large sums a `VertexFinder` takes each run, on several threads. What points two runs have in common, at the border
// between their parts of space, are told by their coordinates; the drawing of the first run stays.
#include "apps/minkowski/convolution/region_vertices.h"

#include <algorithm>
#include <utility>

#include "nef/base/threads/first_equal.h"
#include "nef/base/threads/parallel.h"

namespace nef::minkowski {
namespace {

// Puts the vertices of runs together, each once: the first one at a point stays. The table gets their points.
RegionVertices joined_runs(std::vector<FoundVertices>&& runs, PointTable& points, const Monitor& monitor) {
  struct Place {
    std::uint32_t run, vertex;
  };
  std::vector<Place> places;
  std::vector<std::size_t> first_place;  // of each run
  for (std::uint32_t r = 0; r < runs.size(); ++r) {
    first_place.push_back(places.size());
    for (std::uint32_t v = 0; v < runs[r].vertices.size(); ++v) places.push_back({r, v});
  }
  const auto point_at = [&](std::size_t i) { return runs[places[i].run].vertices[places[i].vertex].point; };
  const auto table_of = [&](std::size_t i) -> const PointTable& { return runs[places[i].run].points; };
  const Monitor own = for_vertices(places.size(), monitor);
  const FirstNumbers vertices = numbers_by_first(first_equal(
      places.size(), own, [&](std::size_t i) { return mixed_bits(table_of(i).hash(point_at(i))); },
      [&](std::uint32_t i, std::uint32_t k) { return table_of(i).identical(point_at(i), table_of(k), point_at(k)); }));
  RegionVertices result;
  for (const std::uint32_t i : vertices.first) points.push_from(table_of(i), point_at(i));
  const std::size_t before = points.size() - vertices.first.size();
  parallel_calls(own, {[&](const Monitor&) {
                         for (const std::uint32_t i : vertices.first) {
                           RegionVertex& v = runs[places[i].run].vertices[places[i].vertex];
                           v.point = PointId{static_cast<std::uint32_t>(before + result.vertices.size())};
                           result.vertices.push_back(std::move(v));
                         }
                       },
                       [&](const Monitor&) {
                         for (std::size_t r = 0; r < runs.size(); ++r) {
                           const auto number = [&](std::uint32_t v) { return vertices.number[first_place[r] + v]; };
                           for (const RegionJoint& j : runs[r].joints) {
                             result.joints.push_back({j.segment, number(j.from), number(j.to)});
                           }
                           result.points += runs[r].located;
                         }
                       }});
  return result;
}

}  // namespace

RegionVertices region_vertices(const FacetArrangement& arrangement, ConvolutionFacets& facets,
                               std::span<const SaddlePoint> saddles, const Monitor& monitor) {
  // Of a run so long some 4 % of the points are those of others, too.
  constexpr std::size_t kIntervalsOfRun = 8192;
  const std::size_t count = arrangement.intervals.intervals.size();
  const bool is_closed = facets.marks == BoundaryMarks::kAll;
  // Passages are looked for among all that was found.
  const std::size_t length = is_closed ? kIntervalsOfRun : std::max(count, kIntervalsOfRun);
  std::vector<FoundVertices> runs(std::max<std::size_t>((count + length - 1) / length, 1));
  parallel_for(runs.size(), monitor, [&](std::size_t run, const Monitor& own) {
    VertexFinder finder(arrangement, own);
    finder.add_intervals(run * length, std::min(count, (run + 1) * length));
    if (!is_closed) finder.add_passages(saddles);
    runs[run] = finder.finish();
  });
  return joined_runs(std::move(runs), facets.points, monitor);
}

}  // namespace nef::minkowski

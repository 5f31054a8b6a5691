// SPDX-License-Identifier: Apache-2.0
//
// A point x is in A + B iff x - B meets A, and in the erosion iff x + B lies in A: both depend on A in a box around x
// alone. So a region's part of the result is that of A cut to the region widened by this box, with a margin, cut to the
// region itself. The margin lets the part be that of an open box as well: A's own boundary then is all there is of an
// open A, and sums of open sets are faster than those of sets that have some of their boundary.
#include "apps/minkowski/sum/regional_sum.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/in_tiles.h"
#include "apps/minkowski/morphology/structuring_set.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/construct/construct.h"
#include "nef/number/floor.h"
#include "nef/tiles/cuts/cutter.h"
#include "nef/tiles/seams/seam_glue.h"

namespace nef::minkowski {
namespace {

using Corners = std::array<Rational3, 2>;

// The box of the boundary in all tiles.
void add_boxes(const TileRef& tree, Box& box) {
  if (tree.node->kind == TileNode::Kind::kTile) box.add(tree.node->box);
  if (tree.node->kind != TileNode::Kind::kCut) return;
  add_boxes(tree.node->low, box);
  add_boxes(tree.node->high, box);
}

Corners box_of(const TiledPolyhedron& a, const Monitor& monitor) {
  if (a.is_empty()) throw InputError("a set is empty: there is nothing to sum");
  Box box;
  add_boxes(a.tree(), box);
  Corners result;
  Rational3 beyond;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(box.low[i]) || !std::isfinite(box.high[i])) {
      throw UnsupportedError("the set in tiles is unbounded, and only bounded ones are summed in tiles");
    }
    result[0][i] = exact_rational(box.low[i]);
    result[1][i] = exact_rational(box.high[i]);
    beyond[i] = result[1][i] + 1;
  }
  if (contains(a, beyond, monitor)) {
    throw UnsupportedError("the set in tiles is unbounded, and only bounded ones are summed in tiles");
  }
  return result;
}

Polyhedron ball_of_offset(const Rational& radius, int splits, Side side, const Monitor& monitor) {
  return to_polyhedron(ball_approximation(abs(radius), splits, ball_side(sgn(radius), side), monitor).cell, monitor);
}

void add_counts(MinkowskiReport& to, const MinkowskiReport& from) {
  to.cells_a += from.cells_a;
  to.cells_b += from.cells_b;
  to.pairs += from.pairs;
  to.pairs_dropped += from.pairs_dropped;
  to.united_at_once += from.united_at_once;
  to.united_two_by_two += from.united_two_by_two;
  to.convolution_facets += from.convolution_facets;
  to.convolution_intervals += from.convolution_intervals;
  to.convolution_points += from.convolution_points;
  to.convolution_regions += from.convolution_regions;
  to.seconds_decomposition += from.seconds_decomposition;
  to.seconds_convex_sums += from.seconds_convex_sums;
  to.seconds_union += from.seconds_union;
  to.predicates_decomposition += from.predicates_decomposition;
  to.predicates_convex_sums += from.predicates_convex_sums;
  to.predicates_union += from.predicates_union;
}

// One entry for all regions that were summed alike.
void add_choices(MinkowskiReport& to, std::span<const MinkowskiReport> regions) {
  std::vector<std::pair<StrategyChoice, std::size_t>> kinds;
  for (const MinkowskiReport& region : regions) {
    for (const StrategyChoice& choice : region.choices) {
      const auto same = std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) {
        return kind.first.chosen == choice.chosen && kind.first.why == choice.why;
      });
      if (same == kinds.end()) {
        kinds.emplace_back(choice, 1);
        continue;
      }
      ++same->second;
      same->first.pairs_of_cells += choice.pairs_of_cells;
      same->first.convolution_facets += choice.convolution_facets;
    }
  }
  for (auto& [choice, count] : kinds) {
    choice.why += "; in " + std::to_string(count) + " of " + std::to_string(regions.size()) + " regions";
    to.choices.push_back(std::move(choice));
  }
}

TiledPolyhedron by_regions(const RegionalSum& sum, const MinkowskiOptions& options, MinkowskiReport& report) {
  const Stopwatch watch;
  const std::size_t count = sum.region_count();
  std::vector<TileRef> trees(count);
  std::vector<MinkowskiReport> reports(count);
  std::atomic<std::size_t> done = 0;
  constexpr std::size_t kAll = 1000;
  parallel_for(count, options.monitor, [&](std::size_t i, const Monitor& own) {
    MinkowskiOptions of_region = options;
    of_region.monitor = own.quiet();
    trees[i] = sum.compute(i, of_region, reports[i]);
    own.tell_progress(kSumPhase, ++done * kAll / count, kAll);
  });
  for (const MinkowskiReport& region : reports) add_counts(report, region);
  add_choices(report, reports);
  report.seconds_total += watch.seconds();
  return sum.whole(trees);
}

TiledPolyhedron in_tiles(RegionalSum::Kind kind, const TiledPolyhedron& a, const Polyhedron& b,
                         const MinkowskiOptions& options, MinkowskiReport* report) {
  MinkowskiReport unused;
  MinkowskiReport& r = report != nullptr ? *report : unused;
  if (!a.is_empty() && !a.is_everything() && !b.is_empty()) {
    return by_regions(RegionalSum(kind, a, b, options.monitor), options, r);
  }
  const Polyhedron whole = a.is_empty() ? Polyhedron() : a.polyhedron(options.monitor);
  const bool is_sum = kind == RegionalSum::Kind::kSum;
  return TiledPolyhedron(is_sum ? minkowski_sum(whole, b, options, &r) : erode(whole, b, options, &r), a.tiling(),
                         options.monitor);
}

}  // namespace

RegionalSum::RegionalSum(Kind kind, const TiledPolyhedron& a, const Polyhedron& b, const Monitor& monitor,
                         std::size_t most)
    : kind_(kind), a_(a), b_(b), box_(box_of(a, monitor)), most_(most) {
  if (b.is_empty()) throw InputError("a set is empty: there is nothing to sum");
  require_bounded(b, "the second set");
  const Corners of_b = bounding_box(b, monitor).value();
  Rational widest;
  for (std::size_t i = 0; i < 3; ++i) {
    reach_[0][i] = kind == Kind::kSum ? Rational(-of_b[1][i]) : of_b[0][i];
    reach_[1][i] = kind == Kind::kSum ? Rational(-of_b[0][i]) : of_b[1][i];
    width_[i] = of_b[1][i] - of_b[0][i];
    if (width_[i] > widest) widest = width_[i];
  }
  if (sgn(widest) > 0) {
    while (margin_ * 16 > widest) margin_ /= 2;
    while (margin_ * 32 <= widest) margin_ *= 2;
  }
  divide(a_.tree(), {});
}

RegionalSum::RegionalSum(const TiledPolyhedron& a, const Rational& radius, int splits, Side side,
                         const Monitor& monitor)
    : RegionalSum(sgn(radius) > 0 ? Kind::kSum : Kind::kErosion, a, ball_of_offset(radius, splits, side, monitor),
                  monitor) {}

bool RegionalSum::is_cut(const TileNode& node, const Region& region) const {
  if (node.kind != TileNode::Kind::kCut || node.vertices <= most_) return false;
  const std::size_t axis = node.plane.axis;
  const Rational low = region.low[axis] != nullptr ? std::max(region.low[axis]->at, box_[0][axis]) : box_[0][axis];
  const Rational high = region.high[axis] != nullptr ? std::min(region.high[axis]->at, box_[1][axis]) : box_[1][axis];
  return high - low >= 4 * width_[axis];
}

void RegionalSum::divide(const TileRef& tree, const Region& region) {
  if (!is_cut(*tree.node, region)) {
    regions_.push_back(region);
    return;
  }
  divide(tree.node->low, region.below(tree.node->plane));
  divide(tree.node->high, region.above(tree.node->plane));
}

TileRef RegionalSum::joined(const TileRef& tree, const Region& region, std::span<const TileRef>& of_regions) const {
  if (!is_cut(*tree.node, region)) {
    TileRef first = of_regions.front();
    of_regions = of_regions.subspan(1);
    return first;
  }
  const AxisPlane& plane = tree.node->plane;
  TileRef low = joined(tree.node->low, region.below(plane), of_regions);
  return cut_node(plane, std::move(low), joined(tree.node->high, region.above(plane), of_regions));
}

// What A has around a region, closed if A is, open if A is.
Polyhedron RegionalSum::part_near(const Region& region, const Monitor& monitor) const {
  Corners box;
  for (std::size_t i = 0; i < 3; ++i) {
    Rational low = box_[0][i];
    Rational high = box_[1][i];
    if (const AxisPlane* wall = region.low[i]) low = std::max(low, Rational(wall->at + reach_[0][i]));
    if (const AxisPlane* wall = region.high[i]) high = std::min(high, Rational(wall->at + reach_[1][i]));
    if (low > high) return {};
    // Short numbers, and strictly beyond.
    box[0][i] = margin_ * Rational(floor_of(low / margin_) - 1);
    box[1][i] = margin_ * Rational(floor_of(high / margin_) + 2);
  }
  const auto part_in = [&](const Polyhedron& around) {
    return glue_tiles(intersect(a_, around, monitor).tree(), {}, monitor);
  };
  const Polyhedron around = make_box(box[0], box[1], monitor);
  Polyhedron part = part_in(around);
  if (part.is_closed()) return part;
  Polyhedron inside = part_in(interior(around, monitor));
  return inside.is_open() ? inside : part;
}

TileRef RegionalSum::compute(std::size_t region, const MinkowskiOptions& options, MinkowskiReport& report) const {
  const Polyhedron part = part_near(regions_[region], options.monitor);
  if (part.is_empty()) return uniform_leaf(0);  // B is not empty
  const Polyhedron all =
      kind_ == Kind::kSum ? minkowski_sum(part, b_, options, &report) : erode(part, b_, options, &report);
  return tiles_in_region(all, regions_[region], a_.tiling(), options.monitor);
}

TiledPolyhedron RegionalSum::whole(std::span<const TileRef> of_regions) const {
  NEF_ASSERT(of_regions.size() == regions_.size());
  return {joined(a_.tree(), {}, of_regions), a_.tiling()};
}

TiledPolyhedron minkowski_sum(const TiledPolyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                              MinkowskiReport* report) {
  return in_tiles(RegionalSum::Kind::kSum, a, b, options, report);
}

TiledPolyhedron erode(const TiledPolyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                      MinkowskiReport* report) {
  return in_tiles(RegionalSum::Kind::kErosion, a, b, options, report);
}

TiledPolyhedron offset(const TiledPolyhedron& a, const Rational& radius, int splits, Side side,
                       const MinkowskiOptions& options, MinkowskiReport* report) {
  if (sgn(radius) == 0) return a;
  const RegionalSum::Kind kind = sgn(radius) > 0 ? RegionalSum::Kind::kSum : RegionalSum::Kind::kErosion;
  return in_tiles(kind, a, ball_of_offset(radius, splits, side, options.monitor), options, report);
}

TiledPolyhedron opening(const TiledPolyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                        MinkowskiReport* report) {
  require_structuring_set(b);
  return minkowski_sum(erode(a, b, options, report), b, options, report);
}

TiledPolyhedron closing(const TiledPolyhedron& a, const Polyhedron& b, const MinkowskiOptions& options,
                        MinkowskiReport* report) {
  require_structuring_set(b);
  return erode(minkowski_sum(a, b, options, report), b, options, report);
}

}  // namespace nef::minkowski

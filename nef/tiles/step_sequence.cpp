// SPDX-License-Identifier: Apache-2.0
//
// Tiles pay if the steps to come touch few of them: then a step costs what it touches instead of the whole set, but
// cutting into tiles costs once. The sequence measures, for every third step, how many vertices a step in tiles would
// have left alone, keeps a moving average, and changes to tiles (or back) if the average times the number of steps to
// come exceeds the cost of cutting and gluing by a margin. It counts vertices and no time, so that a run is
// reproducible. The constants below were measured and decide about speed only.
#include "nef/tiles/step_sequence.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "nef/operation/canonical_order.h"
#include "nef/tiles/cuts/cutter.h"
#include "nef/tiles/tile_tree.h"

namespace nef {
namespace {

// Measured with bench/tiles in units of an operation on the whole set: cutting and gluing together cost about 8, a tile
// costs what as many vertices of a whole set do, and seams make half of them again.
constexpr double kCutAndGlue = 8;
constexpr double kSeams = 1.5;
constexpr double kOperandCut = 4;     // what is not small is cut on the way to the tiles
constexpr double kMargin = 1.5;       // what the prediction must exceed the costs by
constexpr std::size_t kSmallest = 2;  // tiles
// The first steps in tiles, which cut, cost more than plain ones: three in large sets, some more in small ones. By then
// so many steps have been made that this is less than a tenth of them.
constexpr double kEvidence = 30;            // steps
constexpr double kSmallSetSteps = 120'000;  // more, divided by the vertices
constexpr std::size_t kLook = 3;            // every how many steps a step is looked at, while the set is whole
constexpr std::size_t kMemory = 8;          // steps looked at that an average is taken over

// Set, Operand: a Polyhedron or a TiledPolyhedron. Rest: what its operations are given besides.
template <typename Set, typename Operand, typename... Rest>
Set combined(BooleanOperator op, const Set& a, const Operand& b, const Rest&... rest) {
  switch (op) {
    case BooleanOperator::kUnion:
      return unite(a, b, rest...);
    case BooleanOperator::kIntersection:
      return intersect(a, b, rest...);
    case BooleanOperator::kDifference:
      return subtract(a, b, rest...);
    case BooleanOperator::kSymmetricDifference:
      break;
  }
  return symmetric_difference(a, b, rest...);
}

using Places = std::span<std::array<double, 3>>;

// Vertices in the tiles that a box would meet, if they were cut. Reorders the places. O(n) for small boxes.
std::size_t vertices_in(Places places, const Box& box, std::size_t limit) {
  if (places.size() <= limit) return places.size();
  Box bounds;
  for (const std::array<double, 3>& p : places) bounds.add_rounded(p);
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (bounds.high[i] - bounds.low[i] > bounds.high[axis] - bounds.low[axis]) axis = i;
  }
  const std::size_t middle = places.size() / 2;
  std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(middle), places.end(),
                   [axis](const auto& p, const auto& q) { return p[axis] < q[axis]; });
  const double at = places[middle][axis];
  std::size_t count = 0;
  if (box.low[axis] <= at) count += vertices_in(places.first(middle), box, limit);
  if (box.high[axis] >= at) count += vertices_in(places.subspan(middle), box, limit);
  return count;
}

std::size_t vertices_in(const Complex& complex, const Box& box, std::size_t limit) {
  std::vector<std::array<double, 3>> places;
  places.reserve(complex.vertex_count());
  for (const VertexId v : complex.vertex_ids()) {
    if (complex.points.finite(point_of(v))) places.push_back(complex.points.approximate(point_of(v)));
  }
  return vertices_in(places, box, limit);
}

// An uncut tile will be cut.
std::size_t vertices_in(const TileRef& tree, const Box& box, std::size_t limit) {
  if (tree.node->kind != TileNode::Kind::kCut) {
    return tree.node->uncut ? std::min(tree.node->vertices, limit) : tree.node->vertices;
  }
  const int side = tree.node->plane.side(box);
  return (side <= 0 ? vertices_in(tree.node->low, box, limit) : 0) +
         (side >= 0 ? vertices_in(tree.node->high, box, limit) : 0);
}

}  // namespace

StepSequence::StepSequence(Polyhedron start, std::size_t steps, TileUse use, const Tiling& tiling,
                           const Monitor& monitor)
    : plain_(std::move(start)), left_(steps), use_(use), tiling_(tiling) {
  if (use_ == TileUse::kAlways) tiled_.emplace(std::exchange(plain_, Polyhedron()), tiling_, monitor);
}

StepSequence::StepSequence(TiledPolyhedron start, std::size_t steps)
    : tiled_(std::move(start)), left_(steps), use_(TileUse::kAlways), tiling_(tiled_->tiling()) {}

// Vertices that an operation on tiles need not write.
double StepSequence::saving(const Polyhedron& b) const {
  const Box box = measure_tile(b.complex()).box;
  const auto own = static_cast<double>(vertex_count()) / (tiled_ ? kSeams : 1);
  // A tile of a whole set gets walls.
  const double touched = tiled_ ? static_cast<double>(vertices_in(tiled_->tree(), box, tiling_.limit))
                                : kSeams * static_cast<double>(vertices_in(plain_.complex(), box, tiling_.limit));
  return own - touched - kOperandCut * static_cast<double>(b.complex().vertex_count());
}

void StepSequence::choose(const Monitor& monitor) {
  const auto left = static_cast<double>(left_);
  if (tiled_) {
    const double own = static_cast<double>(vertex_count()) / kSeams;
    if (-average_ * left < kCutAndGlue * kMargin * own) return;
    plain_ = tiled_->polyhedron(monitor);
    tiled_.reset();
  } else {
    const auto own = static_cast<double>(vertex_count());
    if (vertex_count() < kSmallest * tiling_.limit) return;
    if (static_cast<double>(seen_) < kEvidence + kSmallSetSteps / own) return;
    if (average_ * left < kCutAndGlue * kMargin * own) return;
    // One tile, which steps cut where they touch it: so none of them pays for all.
    tiled_.emplace(tile_leaf(without_labels(std::exchange(plain_, Polyhedron()), monitor), tiling_.store, true),
                   tiling_);
  }
}

void StepSequence::apply(BooleanOperator op, const Polyhedron& b, const Monitor& monitor) {
  if (use_ == TileUse::kWherePays) {
    choose(monitor);
    // Looking at all vertices of a whole set for every step would cost a twentieth of it.
    if (tiled_ || seen_ % kLook == 0) {
      ++looks_;
      average_ += (saving(b) - average_) / static_cast<double>(std::min(looks_, kMemory));
    }
    ++seen_;
  }
  if (tiled_) {
    tiled_ = combined(op, *tiled_, b, monitor);
  } else {
    plain_ = combined(op, plain_, b, monitor);
  }
  left_ -= std::min<std::size_t>(left_, 1);
}

void StepSequence::apply(BooleanOperator op, const TiledPolyhedron& b, const Monitor& monitor) {
  if (!tiled_) return apply(op, b.polyhedron(monitor), monitor);
  tiled_ = combined(op, *tiled_, b, monitor);
  left_ -= std::min<std::size_t>(left_, 1);
}

std::size_t StepSequence::vertex_count() const {
  return tiled_ ? tiled_->vertex_count() : plain_.complex().vertex_count();
}

TiledPolyhedron StepSequence::tiled(const Tiling& tiling, const Monitor& monitor) const {
  if (!tiled_) return TiledPolyhedron(plain_, tiling, monitor);
  return {fully_cut(tiled_->tree(), tiling_, monitor), tiling_};
}

Polyhedron StepSequence::result(const Monitor& monitor) const {
  return tiled_ ? tiled_->polyhedron(monitor) : in_canonical_order(plain_, monitor);
}

}  // namespace nef

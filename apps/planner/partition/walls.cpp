// SPDX-License-Identifier: Apache-2.0
//
// The polygon of a splitting plane inside its region is handed down: through the tree of the plane
// itself, then through the trees below and above. What arrives in a pair of leaves is a wall.
#include "apps/planner/partition/walls.h"

#include "nef/base/error.h"
#include "nef/base/union_find.h"

namespace nef::planner {
namespace {

class WallCollector {
 public:
  WallCollector(const Complex& complex, const CellNumbering& cells, const SpaceTree& tree,
                const std::function<bool(CellId)>& wanted_facet, const Monitor& monitor)
      : complex_(complex),
        cells_(cells),
        tree_(tree),
        planes_(tree.planes()),
        wanted_facet_(wanted_facet),
        monitor_(monitor) {}

  WallLists run() {
    collect(tree_.root());
    return std::move(out_);
  }

 private:
  using Visit = std::function<void(LeafId, ConvexPiece&&)>;

  void collect(std::uint32_t at) {
    if (SpaceTree::is_leaf(at)) return;
    monitor_.check_interruption();
    const SpaceTree::Node& node = tree_.nodes()[at];
    std::optional<ConvexPiece> polygon = plane_in_box(node.plane, tree_.box(), planes_, out_.points);
    for (std::size_t i = 0; i < 6 && polygon; ++i) {
      SplitPiece parts = split(std::move(*polygon), tree_.box()[i], planes_, out_.points, monitor_);
      polygon = std::move(i % 2 == 0 ? parts.positive : parts.negative);
    }
    for (const auto& [plane, side] : ancestors_) {
      if (!polygon) break;
      SplitPiece parts = split(std::move(*polygon), plane, planes_, out_.points, monitor_);
      polygon = std::move(side < 0 ? parts.negative : parts.positive);
    }
    if (polygon) {
      through_plane(node, node.child[1], std::move(*polygon),
                    [&](LeafId on, ConvexPiece&& piece) { pair_up(node, 2, on, std::move(piece), out_.walls); });
    }
    ancestors_.emplace_back(node.plane, -1);
    collect(node.child[0]);
    ancestors_.back().second = 1;
    collect(node.child[2]);
    ancestors_.pop_back();
  }

  // Hands a polygon of the splitting plane of `cut` down the tree of that plane, and gathers the seams on the way.
  void through_plane(const SpaceTree::Node& cut, std::uint32_t at, ConvexPiece&& polygon, const Visit& visit) {
    if (SpaceTree::is_leaf(at)) {
      visit(SpaceTree::leaf_of(at), std::move(polygon));
      return;
    }
    const SpaceTree::Node& node = tree_.nodes()[at];
    SplitPiece parts = split(std::move(polygon), node.plane, planes_, out_.points, monitor_);
    if (parts.negative && parts.positive) {
      NEF_ASSERT(parts.on.has_value());
      down(node.child[1], std::move(*parts.on), 1,
           [&](LeafId on, ConvexPiece&& piece) { seam(cut, node, on, std::move(piece)); });
    }
    if (parts.negative) through_plane(cut, node.child[0], std::move(*parts.negative), visit);
    if (parts.positive) through_plane(cut, node.child[2], std::move(*parts.positive), visit);
  }

  // A segment of a facet where the plane of `cut` meets another one, that of `line`. If the facet lies in the plane of
  // `cut`, its leaves beside the segment are those of that plane's tree; else they are in the trees below and above.
  void seam(const SpaceTree::Node& cut, const SpaceTree::Node& line, LeafId on, ConvexPiece&& piece) {
    const CellId cell = tree_.leaves()[on].cell;
    if (cell == kNoCell || !wanted_facet_(cell)) return;
    const bool in_plane = complex_.facets[FacetId{cells_.index(cell)}].plane.row() == cut.plane.row();
    pair_up(in_plane ? line : cut, 1, on, std::move(piece), out_.seams);
  }

  // Hands a piece down any subtree; parts of its own dimension arrive at leaves.
  void down(std::uint32_t at, ConvexPiece&& piece, int dimension, const Visit& visit) {
    if (SpaceTree::is_leaf(at)) {
      visit(SpaceTree::leaf_of(at), std::move(piece));
      return;
    }
    const SpaceTree::Node& node = tree_.nodes()[at];
    SplitPiece parts = split(std::move(piece), node.plane, planes_, out_.points, monitor_);
    if (parts.negative) down(node.child[0], std::move(*parts.negative), dimension, visit);
    if (parts.positive) down(node.child[2], std::move(*parts.positive), dimension, visit);
    if (parts.on && parts.on->dimension == dimension) down(node.child[1], std::move(*parts.on), dimension, visit);
  }

  void pair_up(const SpaceTree::Node& node, int dimension, LeafId on, ConvexPiece&& piece, std::vector<Wall>& walls) {
    down(node.child[0], std::move(piece), dimension, [&](LeafId below, ConvexPiece&& part) {
      down(node.child[2], std::move(part), dimension, [&](LeafId above, ConvexPiece&& wall) {
        walls.push_back({node.plane, on, below, above, static_cast<std::uint32_t>(out_.corners.size()),
                         static_cast<std::uint32_t>(wall.points.size())});
        out_.corners.insert(out_.corners.end(), wall.points.begin(), wall.points.end());
      });
    });
  }

  const Complex& complex_;
  const CellNumbering& cells_;
  const SpaceTree& tree_;
  const PlaneTable& planes_;
  const std::function<bool(CellId)>& wanted_facet_;
  Monitor monitor_;
  WallLists out_;
  std::vector<std::pair<PlaneId, int>> ancestors_;
};

// Gives every 3-dimensional leaf its volume.
void name_volumes(const Complex& complex, const CellNumbering& cells, const std::vector<Wall>& walls, SpaceTree& tree) {
  const std::size_t count = tree.leaves().size();
  UnionFind same(count);
  for (const Wall& wall : walls) {
    if (tree.leaves()[wall.on].cell == kNoCell) same.unite(wall.below, wall.above);
  }
  // Leaves without walls lie beyond the box around everything, or there are no facets at all: the outer volume.
  std::vector<CellId> volume(count, cells.volume(kOuterVolume));
  for (const Wall& wall : walls) {
    const CellId cell = tree.leaves()[wall.on].cell;
    if (cell == kNoCell || cells.dimension(cell) != 2) continue;
    const Facet& facet = complex.facets[FacetId{cells.index(cell)}];
    volume[same.find(wall.below)] = cells.volume(facet.volume_below);
    volume[same.find(wall.above)] = cells.volume(facet.volume_above);
  }
  for (LeafId leaf = 0; leaf < count; ++leaf) {
    if (tree.leaves()[leaf].dimension == 3) tree.set_volume(leaf, volume[same.find(leaf)]);
  }
}

}  // namespace

Walls::Walls(const Complex& complex, const CellNumbering& cells, SpaceTree& tree, const Monitor& monitor,
             const std::function<bool(CellId)>& wanted_facet)
    : Walls(WallCollector(complex, cells, tree, wanted_facet, monitor).run()) {
  name_volumes(complex, cells, w_.walls, tree);
}

Rational3 Walls::centre(const Wall& wall) const {
  std::vector<Rational3> corners;
  for (std::uint32_t i = 0; i < wall.point_count; ++i) {
    corners.push_back(w_.points.rational(w_.corners[wall.first_point + i]));
  }
  return mean_of(corners);
}

std::array<double, 3> Walls::approximate_centre(const Wall& wall) const {
  std::array<double, 3> sum{};
  for (std::uint32_t i = 0; i < wall.point_count; ++i) {
    const std::array<double, 3>& x = w_.points.approximate(w_.corners[wall.first_point + i]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += x[k];
  }
  for (double& value : sum) value /= static_cast<double>(wall.point_count);
  return sum;
}

std::vector<std::array<double, 3>> Walls::approximate_corners(const Wall& wall) const {
  std::vector<std::array<double, 3>> result;
  for (std::uint32_t i = 0; i < wall.point_count; ++i) {
    result.push_back(w_.points.approximate(w_.corners[wall.first_point + i]));
  }
  return result;
}

}  // namespace nef::planner

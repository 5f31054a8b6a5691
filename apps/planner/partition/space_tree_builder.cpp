// SPDX-License-Identifier: Apache-2.0
//
// Building the space partition. All pieces are closed; where several cover a region of their own
// dimension, the one of the smallest cell is right, since the boundary of a cell consists of
// smaller cells and those have pieces of their own.
#include <algorithm>
#include <cstdlib>

#include "apps/planner/partition/convex_piece.h"
#include "apps/planner/partition/space_tree.h"
#include "nef/base/error.h"
#include "nef/geometry/predicates.h"

namespace nef::planner {
namespace {

using Pieces = std::vector<ConvexPiece>;

/// An open convex region of dimension 3 or in the given planes.
struct Region {
  int dimension = 3;
  PlaneId p;  // dimension 2 and 1
  PlaneId q;  // dimension 1
};

bool same_plane(PlaneId a, PlaneId b) { return a.valid() && b.valid() && a.row() == b.row(); }

class SpaceTreeBuilder {
 public:
  SpaceTreeBuilder(const Complex& complex, const CellNumbering& cells, const Monitor& monitor)
      : complex_(complex), cells_(cells), monitor_(monitor) {}

  SpaceTree::Parts build() {
    if (complex_.has_box()) {
      throw UnsupportedError("the free space is bounded by infinitely long edges or facets: give the scene a box");
    }
    tree_.planes = complex_.planes;
    points_ = complex_.points;
    make_box();
    Pieces pieces;
    for (const VertexId v : complex_.vertex_ids()) {
      ConvexPiece piece;
      piece.cell = cells_.vertex(v);
      piece.points = {point_of(v)};
      pieces.push_back(std::move(piece));
    }
    for (const HalfedgeId h : complex_.halfedge_ids()) {
      if (complex_.twin[h] < h) continue;
      pieces.push_back(edge_piece(h));
    }
    for (const FacetId f : complex_.facets.ids()) {
      append_facet_pieces(complex_, f, cells_.facet(f), tree_.planes, points_, tree_.box, pieces, monitor_);
    }
    tree_.root = build(std::move(pieces), Region{});
    return std::move(tree_);
  }

 private:
  void make_box() {
    const std::array<Rational3, 2> corners = padded_box(complex_);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Rational3 normal;
      normal[axis] = 1;
      tree_.box[2 * axis] = tree_.planes.intern(normal, -corners[0][axis]);
      tree_.box[2 * axis + 1] = tree_.planes.intern(normal, -corners[1][axis]);
    }
  }

  [[nodiscard]] ConvexPiece edge_piece(HalfedgeId halfedge) const {
    ConvexPiece piece;
    piece.cell = cells_.edge(halfedge);
    piece.dimension = 1;
    piece.p = complex_.svertex(halfedge).p;
    piece.q = complex_.svertex(halfedge).q;
    piece.points = {point_of(complex_.source(halfedge)), point_of(complex_.target(halfedge))};
    return piece;
  }

  std::uint32_t build(Pieces pieces, const Region& region) {
    monitor_.check_interruption();
    const PlaneId plane = choose_plane(pieces, region);
    if (!plane.valid()) return make_leaf(pieces, region);
    std::array<Pieces, 3> parts;
    for (ConvexPiece& piece : pieces) {
      SplitPiece split_piece = split(std::move(piece), plane, tree_.planes, points_, monitor_);
      if (split_piece.negative) parts[0].push_back(std::move(*split_piece.negative));
      if (split_piece.on) parts[1].push_back(std::move(*split_piece.on));
      if (split_piece.positive) parts[2].push_back(std::move(*split_piece.positive));
    }
    pieces = Pieces{};
    const auto node = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.push_back({plane.unflipped(), {}});
    Region on = region;
    --on.dimension;
    if (region.dimension == 3) on.p = plane;
    if (region.dimension == 2) on.q = plane;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t child = build(std::move(parts[i]), i == 1 ? on : region);
      tree_.nodes[node].child[i] = child;
    }
    return node;
  }

  std::uint32_t make_leaf(const Pieces& pieces, const Region& region) {
    SpaceTree::Leaf leaf;
    leaf.dimension = region.dimension;
    for (const ConvexPiece& piece : pieces) {
      if (piece.dimension == region.dimension) leaf.cell = std::min(leaf.cell, piece.cell);
    }
    tree_.leaves.push_back(leaf);
    return SpaceTree::child_of(static_cast<LeafId>(tree_.leaves.size() - 1));
  }

  /// The plane of the next split; invalid where the region is a leaf.
  PlaneId choose_plane(const Pieces& pieces, const Region& region) {
    if (region.dimension == 0) return PlaneId{};
    for (int dimension = region.dimension - 1; dimension >= 0; --dimension) {
      std::vector<const ConvexPiece*> candidates;
      for (const ConvexPiece& piece : pieces) {
        if (piece.dimension == dimension) candidates.push_back(&piece);
      }
      if (candidates.empty()) continue;
      return choose_among(candidates, pieces, region);
    }
    return PlaneId{};
  }

  PlaneId choose_among(const std::vector<const ConvexPiece*>& candidates, const Pieces& pieces, const Region& region) {
    constexpr std::size_t kTried = 7;
    const std::size_t tried = std::min(kTried, candidates.size());
    PlaneId best;
    long best_score = 0;
    for (std::size_t i = 0; i < tried; ++i) {
      const PlaneId plane = plane_of(*candidates[(2 * i + 1) * candidates.size() / (2 * tried)], region);
      if (tried == 1) return plane;
      const long score = score_of(plane, pieces);
      if (!best.valid() || score < best_score) {
        best = plane;
        best_score = score;
      }
    }
    return best;
  }

  /// Splits are expensive, imbalance makes depth, pieces in the plane are done with.
  long score_of(PlaneId plane, const Pieces& pieces) {
    const PlaneId positive = plane.unflipped();
    const std::size_t step = 1 + pieces.size() / 256;
    long crossed = 0;
    long balance = 0;
    long on = 0;
    for (std::size_t i = 0; i < pieces.size(); i += step) {
      const ConvexPiece& piece = pieces[i];
      if (piece.dimension == 0) continue;
      bool above = false;
      bool below = false;
      for (const PointId point : piece.points) {
        const int side = side_of_plane(tree_.planes, positive, points_, point, monitor_);
        above = above || side > 0;
        below = below || side < 0;
        if (above && below) break;
      }
      if (above && below) {
        ++crossed;
      } else if (above || below) {
        balance += above ? 1 : -1;
      } else {
        ++on;
      }
    }
    return 4 * crossed + std::labs(balance) - 2 * on;
  }

  /// A plane through the piece that does not hold the region.
  PlaneId plane_of(const ConvexPiece& piece, const Region& region) {
    if (piece.dimension == 2) return piece.p;
    if (piece.dimension == 1) return same_plane(piece.p, region.p) ? piece.q : piece.p;
    const std::size_t axis = axis_across(region);
    Integer d = -Integer(mpz_class(mpz_srcptr(points_.coordinate(piece.points[0], axis))));
    Integer3 normal;
    normal[axis] = mpz_class(mpz_srcptr(points_.coordinate(piece.points[0], 3)));
    return tree_.planes.intern(normal[0], normal[1], normal[2], d);
  }

  /// An axis whose planes do not hold the region.
  [[nodiscard]] std::size_t axis_across(const Region& region) const {
    if (region.dimension == 3) return 0;
    std::array<bool, 3> along{};
    if (region.dimension == 2) {
      // The plane is the axis-parallel one itself iff its other two components vanish.
      for (std::size_t i = 0; i < 3; ++i) {
        along[i] = tree_.planes.coefficient(region.p, (i + 1) % 3).sign() != 0 ||
                   tree_.planes.coefficient(region.p, (i + 2) % 3).sign() != 0;
      }
    } else {
      const Integer3 direction = Direction::cross(tree_.planes, region.p.unflipped(), region.q.unflipped()).integers();
      for (std::size_t i = 0; i < 3; ++i) along[i] = direction[i] != 0;
    }
    return along[0] ? 0U : along[1] ? 1U : 2U;
  }

  const Complex& complex_;
  const CellNumbering& cells_;
  Monitor monitor_;
  SpaceTree::Parts tree_;
  PointTable points_;
};

}  // namespace

SpaceTree::SpaceTree(const Complex& complex, const CellNumbering& cells, const Monitor& monitor)
    : SpaceTree(SpaceTreeBuilder(complex, cells, monitor).build()) {}

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/sum/fixed_obstacles.h"

#include <algorithm>
#include <utility>

#include "apps/minkowski/decomposition/decomposition.h"
#include "apps/minkowski/union/union_builder.h"
#include "nef/construct/construct.h"

namespace nef::minkowski {
namespace {

ConvexCell closed(ConvexCell cell) {
  cell = opened(std::move(cell));
  cell.boundary = ConvexCell::Boundary::kClosed;
  return cell;
}

// The cells of -robot, open or closed.
std::vector<ConvexCell> reflected(std::span<const Mesh> robot, bool open) {
  std::vector<ConvexCell> cells;
  for (const Mesh& piece : robot) {
    ConvexCell cell;
    cell.dimension = 3;
    cell.mesh = piece;
    cell = negated(cell);
    cells.push_back(open ? opened(std::move(cell)) : std::move(cell));
  }
  return cells;
}

// The inside of a union of closed solids, walls between them included.
std::vector<ConvexCell> inside_of(const std::vector<ConvexCell>& open_solids, const Monitor& monitor) {
  if (open_solids.size() < 2) return open_solids;
  std::vector<Polyhedron> parts;
  for (const ConvexCell& cell : open_solids) parts.push_back(to_polyhedron(closed(cell), monitor));
  return decompose(interior(unite_all(parts, monitor), monitor), monitor);
}

}  // namespace

FixedObstacles::FixedObstacles(std::span<const Polyhedron> obstacles,
                               const std::optional<std::array<Rational3, 2>>& box, bool may_touch,
                               const Monitor& monitor)
    : may_touch_(may_touch), all_(Polyhedron::everything()) {
  if (box) {
    box_ = {(*box)[0], (*box)[1]};
    all_ = make_box((*box)[0], (*box)[1], monitor);
  }
  std::vector<ConvexCell> solid;
  for (const Polyhedron& obstacle : obstacles) {
    const Polyhedron all = closure(obstacle, monitor);
    const Polyhedron thick = all.is_regular() ? all : regularize(all, monitor);
    for (ConvexCell& cell : decompose_open(thick, monitor)) {
      solid_boxes_.push_back(box_of(cell.mesh));
      solid.push_back(may_touch ? std::move(cell) : closed(std::move(cell)));
    }
    if (all.is_regular()) continue;
    for (ConvexCell& cell : decompose(subtract(all, thick, monitor), monitor)) {
      flat_boxes_.push_back(box_of(cell.mesh));
      flat_.push_back(closed(std::move(cell)));
    }
  }
  solid_ = Operand(std::move(solid));
}

FixedObstacles::Box FixedObstacles::box_of(const Mesh& mesh) {
  Box box{mesh.vertices.front(), mesh.vertices.front()};
  for (const Rational3& v : mesh.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (v[k] < box.low[k]) box.low[k] = v[k];
      if (v[k] > box.high[k]) box.high[k] = v[k];
    }
  }
  return box;
}

bool FixedObstacles::matters(const Box& a, const Box& b) const {
  if (!box_) return true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (a.low[k] + b.low[k] > box_->high[k] || a.high[k] + b.high[k] < box_->low[k]) return false;
  }
  return true;
}

Polyhedron FixedObstacles::free_positions(std::span<const Mesh> robot, const Monitor& monitor) const {
  UnionBuilder forbidden(0, monitor.quiet());
  const Operand pieces(reflected(robot, may_touch_));
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Box box = box_of(pieces.cell(i).mesh);
    for (std::size_t k = 0; k < solid_.size(); ++k) {
      if (!matters(box, solid_boxes_[k])) continue;
      monitor.check_interruption();
      forbidden.add(convex_sum(solid_.diagram(k), pieces.diagram(i), monitor));
    }
  }
  if (!flat_.empty()) {
    // What is flat may lie in a wall between pieces of the robot.
    const std::vector<ConvexCell> all = reflected(robot, may_touch_);
    for (const ConvexCell& cell : may_touch_ ? inside_of(all, monitor) : all) {
      const Box box = box_of(cell.mesh);
      for (std::size_t k = 0; k < flat_.size(); ++k) {
        if (!matters(box, flat_boxes_[k])) continue;
        monitor.check_interruption();
        forbidden.add(convex_sum(flat_[k], cell, monitor));
      }
    }
  }
  return subtract(all_, forbidden.finish(), monitor);
}

}  // namespace nef::minkowski

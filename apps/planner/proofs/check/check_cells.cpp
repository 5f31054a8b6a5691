// SPDX-License-Identifier: Apache-2.0
//
// 1. The bounds enclose all positions of the reference point: if the claim has a box, by what that point may be away
//    from the origin. Without a box, all boxes at the bounds are on the side of what is beyond.
// 2. A box is blocked: each corner has a point of the obstacle that is inside the inner piece there (blocked_poses.h).
// 3. No box on the side of the start has a facet in common with one on that of the goal. A path that meets no blocked
//    box can be moved off the edges of boxes, so it goes from box to box through facets. So it stays on its side.
#include <algorithm>
#include <functional>

#include "apps/planner/orientation/orientation_cells.h"
#include "apps/planner/proofs/check/blocked_poses.h"
#include "apps/planner/proofs/check/check_parts.h"
#include "nef/base/threads/parallel.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

using CellsComplaint = std::optional<std::string>;
using Kind = PathProof::PoseCell::Kind;

// A box of poses: coordinates of positions, then parameters.
struct PoseBox {
  std::uint32_t chart = 0;
  std::array<Rational, 6> low, high;
};

// A box of the tree with what is below it.
struct BoxNode {
  PoseBox box;
  const PathProof::PoseCell* cell = nullptr;
  bool at_start = false;  // some box below is on the side of the start
  bool at_goal = false;
  std::vector<BoxNode> halves;
};

// Whether two boxes have a facet in common, or an inner part of a facet may lie between boxes inside of them.
using FacetTest = std::function<bool(const PoseBox&, const PoseBox&)>;

bool overlap(const Rational& a_low, const Rational& a_high, const Rational& b_low, const Rational& b_high) {
  return a_low < b_high && b_low < a_high;
}

// Boxes of one chart, the first one below the second one on an axis.
bool meet_along(std::uint32_t axis, const PoseBox& a, const PoseBox& b) {
  for (std::uint32_t k = 0; k < 6; ++k) {
    if (k == axis ? a.high[k] != b.low[k] : !overlap(a.low[k], a.high[k], b.low[k], b.high[k])) return false;
  }
  return true;
}

bool meet_at(const ChartSeam& seam, const PoseBox& a, const PoseBox& b) {
  if ((seam.side > 0 ? a.high : a.low)[3 + seam.here] != seam.side) return false;
  if ((seam.other_side > 0 ? b.high : b.low)[3 + seam.there] != seam.other_side) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!overlap(a.low[k], a.high[k], b.low[k], b.high[k])) return false;
  }
  return std::all_of(seam.others.begin(), seam.others.end(), [&](const std::array<std::uint32_t, 2>& other) {
    const Rational one = seam.sign * a.low[3 + other[0]];
    const Rational end = seam.sign * a.high[3 + other[0]];
    return overlap(std::min(one, end), std::max(one, end), b.low[3 + other[1]], b.high[3 + other[1]]);
  });
}

class CellsCheck {
 public:
  CellsCheck(const PathProof& proof, const Monitor& monitor)
      : claim_(proof.claim),
        cells_(*proof.cells),
        monitor_(monitor),
        orientations_(Orientations::all()),
        blocked_(proof.claim, orientations_, cells_.reference) {}

  CellsComplaint run() {
    if (claim_.path.size() != 2) return "the path must be two poses, start and goal";
    if (cells_.charts.size() != orientations_.charts().size()) return "there must be a box for each chart";
    if (CellsComplaint complaint = check_bounds()) return complaint;
    if (CellsComplaint complaint = build_charts()) return complaint;
    if (CellsComplaint complaint = check_leaves()) return complaint;
    if (!are_sides_apart()) return "a box on the side of the start has a facet in common with one on that of the goal";
    if (!is_on_side(claim_.path.front(), Kind::kStart)) return "the start is in no box on its side";
    if (!is_on_side(claim_.path.back(), Kind::kGoal)) return "the goal is in no box on its side";
    return std::nullopt;
  }

 private:
  using Leaves = std::vector<const BoxNode*>;

  [[nodiscard]] CellsComplaint check_bounds() const {
    const Rational away = dot(cells_.reference, cells_.reference);
    for (std::size_t k = 0; k < 3; ++k) {
      if (cells_.bounds[0][k] >= cells_.bounds[1][k]) return "the bounds are empty";
      if (!claim_.box) continue;
      for (const Rational& room :
           {Rational((*claim_.box)[0][k] - cells_.bounds[0][k]), Rational(cells_.bounds[1][k] - (*claim_.box)[1][k])}) {
        if (room < 0 || room * room < away) return "the bounds are too narrow for the reference point";
      }
    }
    return std::nullopt;
  }

  // The trees of all charts, at once. The first complaint.
  CellsComplaint build_charts() {
    const std::size_t count = cells_.charts.size();
    roots_.resize(count);
    std::vector<CellsComplaint> complaints(count);
    std::vector<Leaves> leaves(count);
    parallel_for(count, monitor_, [&](std::size_t chart, const Monitor& own) {
      BoxNode& root = roots_[chart];
      root.box.chart = static_cast<std::uint32_t>(chart);
      for (std::size_t k = 0; k < 3; ++k) {
        root.box.low[k] = cells_.bounds[0][k];
        root.box.high[k] = cells_.bounds[1][k];
        root.box.low[3 + k] = -1;
        root.box.high[3 + k] = 1;
      }
      root.cell = &cells_.charts[chart];
      complaints[chart] = build(root, leaves[chart], own);
    });
    for (const Leaves& some : leaves) leaves_.insert(leaves_.end(), some.begin(), some.end());
    return first_of(complaints);
  }

  CellsComplaint build(BoxNode& node, Leaves& leaves, const Monitor& monitor) const {
    monitor.check_interruption();
    const PathProof::PoseCell& cell = *node.cell;
    node.at_start = cell.kind == Kind::kStart;
    node.at_goal = cell.kind == Kind::kGoal;
    if (cell.kind == Kind::kBlocked || cell.kind == Kind::kBeyond) {
      leaves.push_back(&node);
      return std::nullopt;
    }
    if (cell.kind != Kind::kCut) {
      const bool other_side = cells_.outside_at_start ? node.at_goal : node.at_start;
      if (!claim_.box && other_side && is_at_bounds(node.box))
        return "a box at the bounds is not on the side of what is beyond";
      return std::nullopt;
    }
    if (cell.axis > 5 || cell.halves.size() != 2 || cell.at <= node.box.low[cell.axis] ||
        cell.at >= node.box.high[cell.axis]) {
      return "a box is cut outside of it";
    }
    node.halves.reserve(2);  // nothing that is built is copied
    for (const bool upper : {false, true}) {
      BoxNode& half = node.halves.emplace_back();
      half.box = node.box;
      (upper ? half.box.low : half.box.high)[cell.axis] = cell.at;
      half.cell = &cell.halves[upper ? 1 : 0];
      if (CellsComplaint complaint = build(half, leaves, monitor)) return complaint;
      node.at_start = node.at_start || half.at_start;
      node.at_goal = node.at_goal || half.at_goal;
    }
    return std::nullopt;
  }

  // No pose in the boxes that are not cut and on no side is free. The first complaint.
  [[nodiscard]] CellsComplaint check_leaves() const {
    constexpr std::size_t kLeavesAtOnce = 16;
    std::vector<CellsComplaint> complaints(leaves_.size());
    parallel_for_ranges(leaves_.size(), kLeavesAtOnce, monitor_,
                        [&](std::size_t first, std::size_t last, const Monitor& own) {
                          own.check_interruption();
                          for (std::size_t i = first; i < last; ++i) {
                            const PathProof::PoseCell& cell = *leaves_[i]->cell;
                            complaints[i] = cell.kind == Kind::kBlocked ? complaint_about_blocked(leaves_[i]->box, cell)
                                                                        : complaint_about_beyond(leaves_[i]->box, cell);
                            if (complaints[i]) return;
                          }
                        });
    return first_of(complaints);
  }

  static CellsComplaint first_of(const std::vector<CellsComplaint>& complaints) {
    const auto complaint =
        std::find_if(complaints.begin(), complaints.end(), [](const auto& c) { return c.has_value(); });
    return complaint == complaints.end() ? std::nullopt : *complaint;
  }

  [[nodiscard]] bool is_at_bounds(const PoseBox& box) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if (box.low[k] == cells_.bounds[0][k] || box.high[k] == cells_.bounds[1][k]) return true;
    }
    return false;
  }

  static OrientationBox<Rational> orientations_of(const PoseBox& box) {
    return {box.chart, {box.low[3], box.low[4], box.low[5]}, {box.high[3], box.high[4], box.high[5]}};
  }

  [[nodiscard]] CellsComplaint complaint_about_blocked(const PoseBox& box, const PathProof::PoseCell& cell) const {
    std::array<Rational3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
      for (std::size_t k = 0; k < 3; ++k) corners[i][k] = ((i >> k) & 1) != 0 ? box.high[k] : box.low[k];
    }
    return blocked_.complaint(orientations_of(box), corners, cell.robot, cell.obstacle, cell.common, cell.drift);
  }

  // The origin of the robot is at x - R(q) reference.
  [[nodiscard]] CellsComplaint complaint_about_beyond(const PoseBox& box, const PathProof::PoseCell& cell) const {
    if (!claim_.box || cell.side > 5) return "there is no such side of the box";
    const std::size_t k = cell.side % 3;
    const std::vector<ScaledMatrix<Integer>> matrices = mixed_rotations(orientations_, orientations_of(box));
    if (matrices.empty()) return "a box beyond a side has too many orientations";
    const Integer scale = common_denominator(cells_.reference);
    const Integer3 scaled_reference = times(cells_.reference, scale);
    for (const ScaledMatrix<Integer>& m : matrices) {
      Rational reference(scaled_product(m, scaled_reference)[k], m.scale * scale);
      reference.canonicalize();
      if (cell.side < 3 ? box.high[k] - reference >= (*claim_.box)[0][k]
                        : box.low[k] - reference <= (*claim_.box)[1][k]) {
        return "a box is not beyond the side of the claim's box";
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] bool are_sides_apart() const {
    if (!std::all_of(roots_.begin(), roots_.end(), [](const BoxNode& root) { return is_apart_inside(root); }))
      return false;
    const std::vector<ChartSeam>& seams = orientations_.seams();
    return std::all_of(seams.begin(), seams.end(), [&](const ChartSeam& seam) {
      return are_apart(roots_[seam.chart], roots_[seam.other],
                       [&](const PoseBox& a, const PoseBox& b) { return meet_at(seam, a, b); });
    });
  }

  static bool is_apart_inside(const BoxNode& node) {
    if (node.halves.empty()) return true;
    const std::uint32_t axis = node.cell->axis;
    return are_apart(node.halves[0], node.halves[1],
                     [axis](const PoseBox& a, const PoseBox& b) { return meet_along(axis, a, b); }) &&
           is_apart_inside(node.halves[0]) && is_apart_inside(node.halves[1]);
  }

  static bool are_apart(const BoxNode& a, const BoxNode& b, const FacetTest& meet) {
    if (!((a.at_start && b.at_goal) || (a.at_goal && b.at_start)) || !meet(a.box, b.box)) return true;
    for (const BoxNode& half : a.halves) {
      if (!are_apart(half, b, meet)) return false;
    }
    if (!a.halves.empty()) return true;
    for (const BoxNode& half : b.halves) {
      if (!are_apart(a, half, meet)) return false;
    }
    return !b.halves.empty();
  }

  [[nodiscard]] bool is_on_side(const RigidPose& pose, Kind side) const {
    const std::optional<OrientationBox<Rational>> orientation = orientations_.locate(pose.quaternion);
    if (!orientation) return false;
    const Matrix3 turn = rotation_between(pose.quaternion, pose.quaternion);
    PoseBox at;
    bool is_outside = false;
    for (std::size_t k = 0; k < 3; ++k) {
      at.low[k] = at.high[k] = pose.position[k] + dot(turn[k], cells_.reference);
      at.low[3 + k] = orientation->low[k];
      at.high[3 + k] = orientation->high[k];
      is_outside = is_outside || at.low[k] < cells_.bounds[0][k] || at.low[k] > cells_.bounds[1][k];
    }
    if (is_outside && !claim_.box) return cells_.outside_at_start == (side == Kind::kStart);
    return is_in(roots_[orientation->chart], at, side);
  }

  static bool is_in(const BoxNode& node, const PoseBox& at, Kind side) {
    for (std::size_t k = 0; k < 6; ++k) {
      if (at.low[k] < node.box.low[k] || at.high[k] > node.box.high[k]) return false;
    }
    return node.cell->kind == side || std::any_of(node.halves.begin(), node.halves.end(),
                                                  [&](const BoxNode& half) { return is_in(half, at, side); });
  }

  const PathProof::Claim& claim_;
  const PathProof::PoseCells& cells_;
  const Monitor& monitor_;
  Orientations orientations_;
  BlockedPoses blocked_;
  std::vector<BoxNode> roots_;
  Leaves leaves_;  // that are on no side
};

}  // namespace

std::optional<std::string> complaint_about_cells(const PathProof& proof, const Monitor& monitor) {
  return CellsCheck(proof, monitor).run();
}

}  // namespace nef::planner

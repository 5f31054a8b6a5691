// SPDX-License-Identifier: Apache-2.0
//
// As in motion_checker.cpp, a part of the motion comes with the pairs of nodes that its parent could not keep apart, of
// each two bodies. Both ends are looked at first, then parts in the order of their size, or of time.
#include "apps/planner/linkage/linkage_checker.h"

#include <algorithm>
#include <utility>

#include "apps/planner/rigid/close_pieces.h"
#include "apps/planner/rigid/motion_parts.h"
#include "apps/planner/rigid/separation.h"
#include "nef/base/error.h"

namespace nef::planner {

/// One call of LinkageChecker::check.
class LinkageExamination {
 public:
  LinkageExamination(const LinkageChecker& checker, const JointMotion& motion, const CheckLimits& limits,
                     const Monitor& monitor)
      : checker_(checker), motion_(motion), limits_(limits), monitor_(monitor), parts_(limits.in_order) {
    limits_.depth = std::min(limits_.depth, 40U);  // parameters and their complements are exact doubles
  }

  /// Joints that stay: the pose at the beginning.
  LinkageVerdict run_still() {
    const std::vector<Open> all = everything();
    if (collides_at(0, all)) return std::move(verdict_);
    for (const Open& open : all) {
      const LinkageChecker::Compared& two = checker_.compared_[open.compared];
      if (not_apart(two, two.chain.pose(motion_, 0, two.reach), open.pairs, true).empty()) continue;
      verdict_.status = MotionVerdict::Status::kUndecided;
      verdict_.undecided.assign(1, {0, 1});
      break;
    }
    return std::move(verdict_);
  }

  LinkageVerdict run() {
    std::vector<Open> all = everything();
    if (collides_at(0, all)) {
      verdict_.free_until = 0;
      return std::move(verdict_);
    }
    if (!limits_.in_order && collides_at(1, all)) return std::move(verdict_);
    parts_.add({0, 1, 0, std::move(all)});
    while (!parts_.empty()) {
      if (!examine(parts_.next())) return std::move(verdict_);
    }
    if (!verdict_.undecided.empty()) {
      verdict_.status = MotionVerdict::Status::kUndecided;
      std::sort(verdict_.undecided.begin(), verdict_.undecided.end());
    }
    return std::move(verdict_);
  }

 private:
  // What two bodies have left, of their trees.
  struct Open {
    std::size_t compared = 0;
    std::vector<NodePair> pairs;
  };
  using Part = MotionParts<std::vector<Open>>::Part;

  [[nodiscard]] std::vector<Open> everything() const {
    std::vector<Open> all;
    for (std::size_t i = 0; i < checker_.compared_.size(); ++i) all.push_back({i, {{0, 0}}});
    return all;
  }

  // False if the examination has ended.
  bool examine(const Part& part) {
    monitor_.check_interruption();
    ++verdict_.cells;
    const bool last = part.depth >= limits_.depth || verdict_.cells >= limits_.max_cells;
    std::vector<Open> rest;
    for (const Open& open : part.open) {
      const LinkageChecker::Compared& two = checker_.compared_[open.compared];
      const MotionCell cell = two.chain.part(motion_, part.from, part.to, two.reach);
      std::vector<NodePair> near = not_apart(two, cell, open.pairs, last);
      if (!near.empty()) rest.push_back({open.compared, std::move(near)});
    }
    if (rest.empty()) return true;
    if ((!limits_.in_order || last) && collides_at(part.middle(), rest)) {
      verdict_.free_until = part.from;
      return false;
    }
    if (last) {
      if (verdict_.undecided.size() < limits_.max_cells) verdict_.undecided.push_back({part.from, part.to});
      if (!limits_.in_order) return true;
      verdict_.free_until = part.from;
      verdict_.status = MotionVerdict::Status::kUndecided;
      return false;
    }
    parts_.halve(part, std::move(rest));
    return true;
  }

  std::vector<NodePair> not_apart(const LinkageChecker::Compared& two, const MotionCell& cell,
                                  const std::vector<NodePair>& pairs, bool last) {
    return nodes_not_apart(cell, checker_.moving(two), checker_.still(two), pairs, last,
                           [&](std::uint32_t a, std::uint32_t b) {
                             monitor_.check_interruption();
                             place(checker_.moving(two).pieces()[a], cell, rough_moving_);
                             place(checker_.still(two).pieces()[b], rough_still_);
                             return plane_between(rough_moving_, rough_still_) == Separation::kApart;
                           });
  }

  bool collides_at(double s, const std::vector<Open>& all) {
    for (const Open& open : all) {
      const LinkageChecker::Compared& two = checker_.compared_[open.compared];
      const MotionCell cell = two.chain.pose(motion_, s, two.reach);
      const auto overlap_here = [&](std::uint32_t a, std::uint32_t b) { return overlaps(two, cell, a, b); };
      if (!any_close_leaf(cell, checker_.moving(two), checker_.still(two), open.pairs, overlap_here)) continue;
      verdict_.status = MotionVerdict::Status::kCollides;
      verdict_.parameter = s;
      verdict_.link = two.link;
      verdict_.other = two.other;
      return true;
    }
    return false;
  }

  bool overlaps(const LinkageChecker::Compared& two, const MotionCell& cell, std::uint32_t moving,
                std::uint32_t still) {
    const RigidBody::Piece& a = checker_.moving(two).pieces()[moving];
    const RigidBody::Piece& b = checker_.still(two).pieces()[still];
    place(a, cell, rough_moving_);
    keep_face_normals(a, cell, rough_moving_);
    // Points are off by the slack. So are turned normals, as a part of their length, and by that times differences of
    // points no longer than twice the reach, which is below twice the slack: 8 slacks are more than all.
    return overlap(a, rough_moving_, b, 8 * cell.slack) == Separation::kOverlapping;
  }

  const LinkageChecker& checker_;
  JointMotion motion_;
  CheckLimits limits_;
  const Monitor& monitor_;
  MotionParts<std::vector<Open>> parts_;
  LinkageVerdict verdict_;
  RoughPolytope rough_moving_;
  RoughPolytope rough_still_;
};

LinkageChecker::LinkageChecker(Linkage linkage, RigidBody obstacles)
    : linkage_(std::move(linkage)), obstacles_(std::move(obstacles)) {
  require_valid(linkage_);
  const std::vector<Link>& links = linkage_.links;
  const auto has_shape = [&](std::size_t i) { return links[i].body && !links[i].body->nodes().empty(); };
  const auto is_allowed = [&](std::size_t a, std::size_t b) {
    if (links[b].joint.parent == a) return true;
    return std::any_of(linkage_.allowed.begin(), linkage_.allowed.end(), [&](const auto& pair) {
      return pair == std::array{a, b} || pair == std::array{b, a};
    });
  };
  for (std::size_t i = 1; i < links.size(); ++i) {
    if (!has_shape(i)) continue;
    if (!obstacles_.nodes().empty()) compare(i, std::nullopt);
    for (std::size_t j = 0; j < i; ++j) {
      if (has_shape(j) && !is_allowed(j, i)) compare(i, j);
    }
  }
}

void LinkageChecker::compare(std::size_t link, std::optional<std::size_t> other) {
  LinkChain chain(linkage_, other.value_or(0), link);
  if (chain.is_rigid()) return;
  double reach = 0;
  for (const RigidBody::Piece& piece : linkage_.links[link].body->pieces()) reach = std::max(reach, piece.reach);
  compared_.push_back({std::move(chain), link, other, reach});
}

LinkageVerdict LinkageChecker::check(std::span<const double> from, std::span<const double> to,
                                     const CheckLimits& limits, const Monitor& monitor) const {
  NEF_ASSERT(from.size() == linkage_.dimension() && to.size() == from.size());
  return LinkageExamination(*this, {from, to}, limits, monitor).run();
}

LinkageVerdict LinkageChecker::check(std::span<const double> values) const {
  NEF_ASSERT(values.size() == linkage_.dimension());
  const Monitor nobody;
  return LinkageExamination(*this, {values, values}, {}, nobody).run_still();
}

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// Ranges of motion of hinges and sliders on a grid, against Booleans of the moved part: at values spread over the
// range, at the ends of parts where these are rational, and just before and after each end.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "apps/planner/mechanism/range_of_motion.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/polyhedron.h"

namespace nef::fuzz {
namespace {

using planner::Joint;
using planner::Mechanism;
using planner::RangeOfMotion;
using planner::RangePart;
using planner::RangeStatus;

Rational half(int x) {
  Rational r(x, 2);
  r.canonicalize();
  return r;
}

class RangeCase {
 public:
  explicit RangeCase(const Case& the_case) : case_(the_case) { draw(); }

  void run() {
    const RangeOfMotion range = planner::range_of_motion(m_);
    check_cover(range);
    constexpr int kSamples = 12;
    for (int k = 0; k <= kSamples; ++k) {
      Rational share(k, kSamples);
      share.canonicalize();
      check_at(range, m_.low + share * (m_.high - m_.low));
    }
    for (const RangePart& part : range.parts) {
      const bool rational = part.to.value.is_rational();
      if (rational) check_at(range, part.to.value.rational);
      auto [before, after] = planner::enclosure(part.to.value, 40);
      if (rational) {
        before -= Rational(1, 1 << 30);
        after += Rational(1, 1 << 30);
      }
      if (before >= m_.low) check_at(range, before);
      if (after <= m_.high) check_at(range, after);
    }
    case_.count("ranges");
    case_.count("parts", range.parts.size());
    case_.count("events", range.events);
  }

 private:
  Rational3 random_point(int spread) {
    Choices& choices = case_.choices();
    return {half(choices.between(-spread, spread)), half(choices.between(-spread, spread)),
            half(choices.between(-spread, spread))};
  }

  // Boxes, hulls of points, what remains of a box, balls of few faces, or two of them.
  Polyhedron random_solid(const std::string& name, int spread, bool may_be_two = true) {
    Choices& choices = case_.choices();
    const Rational3 at = random_point(spread);
    const auto shifted = [&](const Rational3& by) { return Rational3{at[0] + by[0], at[1] + by[1], at[2] + by[2]}; };
    if (may_be_two && choices.one_in(5)) {
      return unite(random_solid(name, spread, false), random_solid(name, spread, false));
    }
    std::vector<Rational3> points;
    if (choices.one_in(2)) {
      for (std::uint32_t n = 4 + choices.below(12); n > 0; --n) points.push_back(shifted(random_point(4)));
    }
    Polyhedron set = points.empty() ? Polyhedron() : convex_hull(points);
    if (!points.empty() && !set.is_empty() && set.is_regular()) {
      std::string text = name + ": hull";
      for (const Rational3& p : points) text += " " + to_string(p[0]) + "," + to_string(p[1]) + "," + to_string(p[2]);
      case_.tell(text);
      return set;
    }
    const Rational3 size{half(choices.between(1, 6)), half(choices.between(1, 6)), half(choices.between(1, 6))};
    case_.tell(name + ": box at " + to_string(at[0]) + "," + to_string(at[1]) + "," + to_string(at[2]) + " of " +
               to_string(size[0]) + "," + to_string(size[1]) + "," + to_string(size[2]));
    set = make_box(at, shifted(size));
    if (!choices.one_in(3)) return set;
    const Polyhedron rest = regularize(subtract(set, make_box(shifted(random_point(2)), shifted({1, 1, 1}))));
    case_.tell("less a box at the corner");
    return rest.is_empty() ? set : rest;
  }

  void draw() {
    Choices& choices = case_.choices();
    m_.name = "random";
    m_.moving = random_solid("moving", 4);
    for (std::uint32_t k = 1 + choices.below(2); k > 0; --k) {
      m_.fixed.push_back(random_solid("fixed", 8));
      m_.fixed_names.emplace_back("fixed");
    }
    static const std::vector<Rational3> kAxes{{0, 0, 1}, {1, 2, 2}, {1, 1, 0}, {0, 1, 0}, {1, 1, 1}, {-2, 3, 6}};
    const Rational3 axis = choices.element(kAxes);
    if (choices.one_in(3)) {
      m_.joint = Joint::slider(axis);
      m_.low = -choices.between(1, 8);
      m_.high = choices.between(1, 8);
      case_.tell("slider");
    } else {
      m_.joint = Joint::hinge(axis, random_point(2));
      m_.low = half(choices.between(-4, 0));
      m_.high = m_.low + half(choices.between(1, 8));
      case_.tell("hinge about " + to_string(m_.joint.point()[0]) + "," + to_string(m_.joint.point()[1]) + "," +
                 to_string(m_.joint.point()[2]));
    }
    case_.tell("along " + to_string(axis[0]) + "," + to_string(axis[1]) + "," + to_string(axis[2]) + " from " +
               to_string(m_.low) + " to " + to_string(m_.high));
  }

  static void check_join(const RangePart& before, const RangePart& after) {
    Case::require(compare(before.to.value, after.from.value) == 0, "cover: there is a gap");
    Case::require(before.status != after.status, "cover: two parts are one");
    Case::require(before.status == RangeStatus::kTouching || after.status == RangeStatus::kTouching,
                  "cover: free becomes colliding");
  }

  void check_cover(const RangeOfMotion& range) const {
    Case::require(!range.parts.empty() && compare(range.parts.front().from.value, m_.low) == 0 &&
                      compare(range.parts.back().to.value, m_.high) == 0,
                  "cover: not the whole range");
    for (std::size_t i = 0; i + 1 < range.parts.size(); ++i) check_join(range.parts[i], range.parts[i + 1]);
  }

  static RangeStatus told_status(const RangeOfMotion& range, const Rational& value) {
    RangeStatus told = RangeStatus::kUndecided;
    for (const RangePart& part : range.parts) {
      const int from = compare(part.from.value, value);
      const int to = compare(part.to.value, value);
      if (from > 0 || to < 0) continue;
      if (told != RangeStatus::kTouching) told = part.status;
    }
    return told;
  }

  // A hinge's quaternion must turn by the degrees of its value.
  void check_turn(const planner::RigidPose& pose, const Rational& value) const {
    if (m_.joint.kind() != Joint::Kind::kHinge) return;
    const auto at = [&](std::size_t k) { return nearest_double(pose.quaternion[k]); };
    const double sine = std::sqrt(at(1) * at(1) + at(2) * at(2) + at(3) * at(3));
    const double half_angle = m_.joint.measure_of(value) * M_PI / 360;
    const double off = std::fabs(sine * std::fabs(std::cos(half_angle)) - std::fabs(at(0) * std::sin(half_angle)));
    Case::require(off <= 1e-9 * (sine + std::fabs(at(0))), "turn: another angle than " + to_string(value));
  }

  void check_at(const RangeOfMotion& range, const Rational& value) const {
    const planner::RigidPose pose = m_.joint.pose(value);
    check_turn(pose, value);
    const Rational3& c = m_.joint.point();
    const AffineMap turn{planner::rotation_between(pose.quaternion, pose.quaternion), pose.position};
    const AffineMap map = AffineMap::translate(c).after(turn).after(AffineMap::translate({-c[0], -c[1], -c[2]}));
    const Polyhedron moved = transform(m_.moving, map);
    RangeStatus truth = RangeStatus::kFree;
    for (const Polyhedron& fixed : m_.fixed) {
      if (truth == RangeStatus::kColliding || intersect(moved, fixed).is_empty()) continue;
      truth = intersect(interior(moved), interior(fixed)).is_empty() ? RangeStatus::kTouching : RangeStatus::kColliding;
    }
    static constexpr std::array kWords{"free", "touching", "colliding", "undecided"};
    const auto word = [](RangeStatus status) { return std::string(kWords.at(static_cast<std::size_t>(status))); };
    const RangeStatus told = told_status(range, value);
    Case::require(told == truth, "status: " + word(told) + " where it is " + word(truth) + ", at " + to_string(value));
    case_.count("values " + word(truth));
  }

  const Case& case_;
  Mechanism m_;
};

}  // namespace

void fuzz_ranges(const Case& the_case) { RangeCase(the_case).run(); }

}  // namespace nef::fuzz

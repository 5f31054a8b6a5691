// SPDX-License-Identifier: Apache-2.0
//
// Status at a rational value is that of two MotionChecker, one that allows contact and one that does not. At an event
// it follows from the values on both sides: colliding is open, touching or colliding is closed. Where both sides
// collide, or both are free, the pieces that have an event there are compared in its own field. An event of a screw has
// no such field, but is an interval: what its pieces do in all of it is known in doubles, or by a slider at one turn,
// or is not.
#include "apps/planner/mechanism/range_of_motion.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "apps/planner/intersection/hulls_apart.h"
#include "apps/planner/mechanism/contact_stops.h"
#include "apps/planner/mechanism/joint_events.h"
#include "apps/planner/rigid/close_pieces.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid/separation.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

// Cells begin with this part of a quarter, or of the range of a slider.
constexpr unsigned kFirstCells = 16;
// Cells are halved so many times at most before their events are found,
constexpr unsigned kDepth = 7;
// or those of joints without contact products before they are undecided.
constexpr unsigned kLastDepth = 26;
// A cell with so few products is not halved.
constexpr std::size_t kFewProducts = 3000;
// So many cells of a joint without contact products are made of one of the first cells: what keeps contact all the time
// would be halved to the last depth everywhere.
constexpr std::size_t kMostCells = 8000;
// Values of a screw between two events are known with so many bits.
constexpr unsigned kSampleBits = 100;

struct Shifted {
  Polyhedron moving;
  std::vector<Polyhedron> fixed;
};

// With the joint's point at the origin.
Shifted shifted(const Mechanism& m, const Monitor& monitor) {
  const Rational3& point = m.joint.point();
  const AffineMap back = AffineMap::translate({-point[0], -point[1], -point[2]});
  Shifted result;
  result.moving = transform(m.moving, back, monitor);
  for (const Polyhedron& fixed : m.fixed) result.fixed.push_back(transform(fixed, back, monitor));
  return result;
}

class RangeSearch {
 public:
  RangeSearch(const Mechanism& mechanism, const Monitor& monitor)
      : m_(mechanism),
        monitor_(monitor),
        sets_(shifted(mechanism, monitor)),
        moving_(RigidBody::of_set(sets_.moving, monitor)),
        fixed_(RigidBody::together(bodies())),
        allowing_(moving_, fixed_, ContactRule::kAllow),
        forbidding_(moving_, fixed_, ContactRule::kForbid) {
    for (const RigidBody::Piece& piece : moving_.pieces()) pieces_.moving.emplace_back(piece);
    for (const RigidBody::Piece& piece : fixed_.pieces()) pieces_.fixed.emplace_back(piece);
    const Vector3d centre = to_vector(m_.joint.turning_point());
    for (const RigidBody::Piece& piece : moving_.pieces()) {
      for (const Vector3d& point : piece.points) reach_ = std::max(reach_, (point - centre).norm());
    }
    reach_ = reach_ * (1 + 0x1p-20) + 0x1p-40 * moving_.nodes().front().reach;  // for roundings
    if (m_.joint.kind() == Joint::Kind::kFourBar) find_levels();
  }

  RangeOfMotion run() {
    m_.joint.require_range(m_.low, m_.high);
    std::vector<Rational> breaks = m_.joint.breaks(m_.low, m_.high);
    breaks.insert(breaks.begin(), m_.low);
    breaks.push_back(m_.high);
    breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      Rational from = breaks[i];
      for (unsigned k = 1; k <= kFirstCells; ++k) {
        Rational share(k, kFirstCells);
        share.canonicalize();
        const Rational to = breaks[i] + share * (breaks[i + 1] - breaks[i]);
        cells_left_ = kMostCells;
        examine(from, to, nullptr, 0);
        from = to;
      }
    }
    return std::move(result_);
  }

 private:
  std::vector<RigidBody> bodies() {
    std::vector<RigidBody> result;
    for (const Polyhedron& set : sets_.fixed) {
      result.push_back(RigidBody::of_set(set, monitor_));
      owners_.insert(owners_.end(), result.back().pieces().size(), result.size() - 1);
    }
    return result;
  }

  // A four-bar linkage moves in planes across its axis. Two pieces that have only such a plane in common never overlap,
  // and they touch when they would overlap if one of them were shifted along the axis.
  void find_levels() {
    const Rational3& n = m_.joint.axis();
    const auto extent = [&](const RigidBody::Piece& piece) {
      std::array<Rational, 2> result{dot(n, piece.mesh.vertices.front()), dot(n, piece.mesh.vertices.front())};
      for (const Rational3& v : piece.mesh.vertices) {
        result[0] = std::min(result[0], dot(n, v));
        result[1] = std::max(result[1], dot(n, v));
      }
      return result;
    };
    for (std::uint32_t i = 0; i < moving_.pieces().size(); ++i) {
      const std::array<Rational, 2> a = extent(moving_.pieces()[i]);
      for (std::uint32_t j = 0; j < fixed_.pieces().size(); ++j) {
        const std::array<Rational, 2> b = extent(fixed_.pieces()[j]);
        if (a[0] != b[1] && a[1] != b[0]) continue;
        const Rational way = (a[0] + a[1] - b[0] - b[1]) / 2 / dot(n, n);
        levels_.emplace(PiecePair{i, j},
                        RigidBody::of_set(transform(convex_hull(fixed_.pieces()[j].mesh.vertices),
                                                    AffineMap::translate({way * n[0], way * n[1], way * n[2]}))));
      }
    }
  }

  // The piece that stays, where it may overlap the other one of the pair.
  [[nodiscard]] const RigidBody::Piece& fixed_piece(const PiecePair& pair) const {
    const auto level = levels_.find(pair);
    return level == levels_.end() ? fixed_.pieces()[pair[1]] : level->second.pieces().front();
  }

  // Cells in order; `near` are the pairs that a wider cell left.
  void examine(const Rational& from, const Rational& to, const std::vector<PiecePair>* near, unsigned depth) {
    monitor_.check_interruption();
    ++result_.cells;
    cells_left_ -= std::min<std::size_t>(cells_left_, 1);
    const Joint::Sweep sweep = m_.joint.sweep(from, to, reach_);
    if (sweep.all.wide) {
      const Rational middle = (from + to) / 2;
      examine(from, middle, near, depth + 1);
      return examine(middle, to, near, depth + 1);
    }
    const std::vector<PiecePair> pairs = not_apart(sweep.all, near);
    if (pairs.empty()) return add_all(RangeStatus::kFree, from, to);
    std::vector<PiecePair> others = pairs;
    std::erase_if(others, [&](const PiecePair& pair) { return levels_.count(pair) > 0; });
    const bool may_overlap = !others.empty();
    if (all_collide(sweep, may_overlap ? others : pairs)) {
      return add_all(may_overlap ? RangeStatus::kColliding : RangeStatus::kTouching, from, to);
    }
    const bool has_products = m_.joint.has_products();
    std::size_t cost = 0;
    for (const PiecePair& pair : pairs) cost += event_cost(pieces_.moving[pair[0]], pieces_.fixed[pair[1]]);
    if (depth < (has_products ? kDepth : kLastDepth) && (has_products ? cost > kFewProducts : cells_left_ > 0)) {
      const Rational middle = (from + to) / 2;
      examine(from, middle, &pairs, depth + 1);
      examine(middle, to, &pairs, depth + 1);
    } else if (!has_products) {
      add_interval(RangeStatus::kUndecided, {from, std::nullopt, {}}, {to, std::nullopt, {}});
    } else {
      find_events(from, to, pairs);
    }
  }

  // The pairs that may come nearer than doubles can tell in the cell.
  std::vector<PiecePair> not_apart(const MotionCell& cell, const std::vector<PiecePair>* near) {
    std::vector<PiecePair> result;
    const auto look_at = [&](const PiecePair& pair) {
      place(moving_.pieces()[pair[0]], cell, rough_moving_);
      place(fixed_piece(pair), rough_fixed_);
      if (plane_between(rough_moving_, rough_fixed_) != Separation::kApart) result.push_back(pair);
    };
    if (near != nullptr) {
      for (const PiecePair& pair : *near) look_at(pair);
    } else {
      any_close_leaf(cell, moving_, fixed_, root_pair(moving_, fixed_), [&](std::uint32_t a, std::uint32_t b) {
        look_at({a, b});
        return false;  // all of them
      });
    }
    return result;
  }

  // Do two pieces overlap at the middle, so deeply that they do in all of the cell?
  bool all_collide(const Joint::Sweep& sweep, const std::vector<PiecePair>& pairs) {
    for (const PiecePair& pair : pairs) {
      const RigidBody::Piece& a = moving_.pieces()[pair[0]];
      // A rotation by x moves a point at distance r by 2 r sin(x / 2) at most, and turn_spread is that times sqrt(2);
      // the roundings of both are far below the rest.
      const double reach = a.reach + sweep.all.position_reach;
      const double slack =
          (sweep.all.turn_spread * a.reach + sweep.all.position_spread + sweep.middle_error) * (1 + 0x1p-20) +
          0x1p-40 * reach;
      place(a, sweep.middle, rough_moving_);
      keep_face_normals(a, sweep.middle, rough_moving_);
      if (overlap(a, rough_moving_, fixed_piece(pair), slack) == Separation::kOverlapping) return true;
    }
    return false;
  }

  RangeStatus status_at(const Rational& value) {
    const auto [at, is_new] = known_.try_emplace(value, RangeStatus::kFree);
    if (!is_new) return at->second;
    const RigidPose pose = m_.joint.pose(value);
    const auto collides = [&](const MotionChecker& checker) {
      return checker.check(pose).status == MotionVerdict::Status::kCollides;
    };
    at->second = !collides(forbidding_) ? RangeStatus::kFree
                 : collides(allowing_)  ? RangeStatus::kColliding
                                        : RangeStatus::kTouching;
    return at->second;
  }

  void find_events(const Rational& from, const Rational& to, const std::vector<PiecePair>& pairs) {
    const bool screws = m_.joint.kind() == Joint::Kind::kScrew;
    ScrewEvents of_screw;
    if (screws) of_screw = screw_events(m_.joint, pieces_, pairs, from, to, monitor_);
    std::vector<JointEvent> events =
        screws ? std::move(of_screw.events) : exact_events(m_.joint, pieces_, pairs, from, to);
    products_ = std::move(of_screw.products);
    result_.events += events.size();
    // The cell's ends are events, too.
    if (events.empty() || compare(events.front().value, from) != 0) events.insert(events.begin(), end_of_cell(from));
    if (events.back().bounds(kSampleBits)[1] != to) events.push_back(end_of_cell(to));
    std::vector<Rational> samples;
    std::vector<RangeStatus> between;
    for (std::size_t i = 0; i + 1 < events.size(); ++i) {
      samples.push_back(value_between(events[i], events[i + 1]));
      between.push_back(is_typical({from, to}, samples.back()) ? status_at(samples.back()) : RangeStatus::kUndecided);
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
      const RangeStatus before = i == 0 ? between.front() : between[i - 1];
      const RangeStatus after = i + 1 == events.size() ? between.back() : between[i];
      const RangeStatus at = status_of(events[i], before, after, {pairs, samples[i == 0 ? 0 : i - 1]});
      const bool changes = at != before || at != after;
      std::vector<ContactPair> stops =
          changes ? stops_at(events[i], m_.joint, pieces_, {sets_.moving, sets_.fixed, owners_})
                  : std::vector<ContactPair>{};
      if (events[i].single) {
        add_value(at, events[i].end(std::move(stops)));
      } else {
        add_interval(at, {(*events[i].between)[0], std::nullopt, stops},
                     {(*events[i].between)[1], std::nullopt, stops});
      }
      if (i + 1 < events.size()) add_interval(between[i], upper_end(events[i]), events[i + 1].end());
    }
  }

  // Where what follows begins.
  static RangeEnd upper_end(const JointEvent& event) {
    return event.single ? event.end() : RangeEnd{(*event.between)[1], std::nullopt, {}};
  }

  // Is the status of a value what pose() tells, whose position may be a little off? No product changes its sign there.
  [[nodiscard]] bool is_typical(const ScrewPart& part, const Rational& value) const {
    if (m_.joint.kind() != Joint::Kind::kScrew) return true;
    return std::all_of(products_.begin(), products_.end(), [&](const ScrewProduct& product) {
      return sign_over(product, part, value, quarters(value, kSampleBits)).has_value();
    });
  }

  // The pairs of a cell that may meet, and a value next to an event, with no event between the two.
  struct Beside {
    const std::vector<PiecePair>& pairs;
    const Rational& value;
  };

  // At the ends of the cell `before` or `after` is not known, and the other one stands for it: what follows from both
  // being equal is right then, too, since it is found by looking at the value itself.
  RangeStatus status_of(const JointEvent& event, RangeStatus before, RangeStatus after, const Beside& beside) {
    if (event.items.empty()) return after;  // nothing changes
    if (before == RangeStatus::kUndecided || after == RangeStatus::kUndecided) return RangeStatus::kUndecided;
    const bool collides_before = before == RangeStatus::kColliding;
    const bool collides_after = after == RangeStatus::kColliding;
    if (event.between && before == after && before != RangeStatus::kTouching) {
      if (stays(event, before, beside.pairs)) return before;
      const bool is_rational = event.algebraic && event.algebraic->is_rational();
      return is_rational ? status_at_turn(event.algebraic->rational) : RangeStatus::kUndecided;
    }
    if (!event.single) return RangeStatus::kUndecided;
    if (collides_before && collides_after) {
      return overlap_at(event, beside) ? RangeStatus::kColliding : RangeStatus::kTouching;
    }
    if (before != RangeStatus::kFree || after != RangeStatus::kFree) return RangeStatus::kTouching;
    return touch_at(event) ? RangeStatus::kTouching : RangeStatus::kFree;
  }

  // Are the pieces apart, or does a pair collide, as far as doubles can tell, in all of an event of a screw?
  bool stays(const JointEvent& event, RangeStatus status, const std::vector<PiecePair>& pairs) {
    const Joint::Sweep sweep = m_.joint.sweep((*event.between)[0], (*event.between)[1], 0);
    return status == RangeStatus::kFree ? not_apart(sweep.all, &pairs).empty() : all_collide(sweep, pairs);
  }

  // Of a screw at a rational turn. The number of quarters is transcendental there, and the values of a slider at which
  // something changes are rational, so nothing changes if it is enclosed narrowly enough.
  RangeStatus status_at_turn(const Rational& turn) {
    if (m_.joint.direction() == Rational3{}) return status_at(turn);
    const Quaternion q = m_.joint.pose(turn).quaternion;
    Mechanism slide;
    slide.moving = transform(sets_.moving, {rotation_between(q, q), Rational3{}}, monitor_);
    slide.fixed = sets_.fixed;
    slide.joint = Joint::slider(m_.joint.direction());
    for (unsigned bits = kSampleBits;; bits *= 2) {
      const std::array<Rational, 2> way = quarters(turn, bits);
      slide.low = way[0];
      slide.high = way[1];
      const RangeOfMotion range = range_of_motion(slide, monitor_);
      if (range.parts.size() == 1) return range.parts.front().status;
    }
  }

  // Does a pair that has an event touch there? None overlaps next to it.
  bool touch_at(const JointEvent& event) {
    std::vector<PiecePair> concerned;
    for (const auto& [pair, items] : event.items) concerned.push_back(pair);
    concerned.erase(std::unique(concerned.begin(), concerned.end()), concerned.end());
    const std::vector<PiecePair> open = not_apart(m_.joint.sweep(event.value).all, &concerned);
    return std::any_of(open.begin(), open.end(), [&](const PiecePair& pair) {
      return PlacedPiece(pieces_.moving[pair[0]], m_.joint, event.value).touches(pieces_.fixed[pair[1]]);
    });
  }

  // Does a pair of the cell overlap at an event, next to which some pairs do?
  bool overlap_at(const JointEvent& event, const Beside& beside) {
    const Joint::Sweep sweep = m_.joint.sweep(event.value);
    if (all_collide(sweep, beside.pairs)) return true;
    const std::vector<PiecePair> open = not_apart(sweep.all, &beside.pairs);
    return std::any_of(open.begin(), open.end(), [&](const PiecePair& pair) {
      if (!overlap_at(beside.value, pair)) return false;
      const PlacedPiece placed(pieces_.moving[pair[0]], m_.joint, event.value);
      return std::none_of(event.items.begin(), event.items.end(), [&](const auto& item) {
        return item.first == pair && placed.is_between(pieces_.fixed[pair[1]], item.second);
      });
    });
  }

  // Exactly.
  bool overlap_at(const Rational& value, const PiecePair& pair) const {
    const RigidPose pose = m_.joint.pose(value);
    const Matrix3 turn = rotation_between(pose.quaternion, pose.quaternion);
    std::vector<Rational3> placed;
    for (const Rational3& x : pieces_.moving[pair[0]].vertices()) {
      placed.push_back(
          {dot(turn[0], x) + pose.position[0], dot(turn[1], x) + pose.position[1], dot(turn[2], x) + pose.position[2]});
    }
    return !hulls_are_apart(placed, pieces_.fixed[pair[1]].vertices(), false);
  }

  void add_all(RangeStatus status, const Rational& from, const Rational& to) {
    const auto end = [](const Rational& value) { return RangeEnd{value, std::nullopt, {}}; };
    add_value(status, end(from));
    add_interval(status, end(from), end(to));
    add_value(status, end(to));
  }

  // Append a value, or an open interval, to what is known.
  void add_value(RangeStatus status, const RangeEnd& at) {
    if (!continues(status, at)) result_.parts.push_back({status, at, at});
  }
  void add_interval(RangeStatus status, const RangeEnd& from, const RangeEnd& to) {
    if (!continues(status, to)) result_.parts.push_back({status, from, to});
  }
  bool continues(RangeStatus status, const RangeEnd& to) {
    if (result_.parts.empty() || result_.parts.back().status != status) return false;
    result_.parts.back().to = to;
    return true;
  }

  const Mechanism& m_;
  Monitor monitor_;
  Shifted sets_;
  std::vector<std::size_t> owners_;  // of pieces of the others
  RigidBody moving_;
  RigidBody fixed_;
  MotionChecker allowing_;
  MotionChecker forbidding_;
  MechanismPieces pieces_;
  std::map<Rational, RangeStatus> known_;
  // Of pairs that have only a plane across the axis in common: the piece that stays.
  std::map<PiecePair, RigidBody> levels_;
  std::size_t cells_left_ = 0;
  std::vector<ScrewProduct> products_;  // of a screw, in the cell that is looked at
  double reach_ = 0;                    // of the moving part, from the joint's turning point
  RangeOfMotion result_;
  RoughPolytope rough_moving_;
  RoughPolytope rough_fixed_;
};

}  // namespace

const char* status_name(RangeStatus status) {
  switch (status) {
    case RangeStatus::kFree:
      return "free";
    case RangeStatus::kTouching:
      return "touching";
    case RangeStatus::kColliding:
      return "colliding";
    case RangeStatus::kUndecided:
      break;
  }
  return "undecided";
}

RangeOfMotion range_of_motion(const Mechanism& mechanism, const Monitor& monitor) {
  return RangeSearch(mechanism, monitor).run();
}

}  // namespace nef::planner

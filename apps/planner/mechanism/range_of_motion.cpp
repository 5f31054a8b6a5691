// SPDX-License-Identifier: Apache-2.0
//
// Status at a rational value is that of two MotionChecker, one that allows contact and one that does not. At an event
// it follows from the values on both sides: colliding is open, touching or colliding is closed. Where both sides
// collide, or both are free, the pieces that have an event there are compared in its own field.
#include "apps/planner/mechanism/range_of_motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "apps/planner/intersection/hulls_apart.h"
#include "apps/planner/mechanism/contact_events.h"
#include "apps/planner/rigid/close_pieces.h"
#include "apps/planner/rigid/motion_checker.h"
#include "apps/planner/rigid/separation.h"
#include "nef/geometry/vectors.h"
#include "nef/number/interval.h"
#include "nef/number/simplest_between.h"
#include "nef/query/location_name.h"

namespace nef::planner {
namespace {

using Pair = std::array<std::uint32_t, 2>;  // pieces: of the moving part, and of the others

// Cells begin with this part of a quarter, or of the range of a slider.
constexpr unsigned kFirstCells = 16;
// Cells are halved so many times at most before their events are found,
constexpr unsigned kDepth = 7;
// or those of joints that are not algebraic before they are undecided.
constexpr unsigned kLastDepth = 26;
// A cell with so few products is not halved.
constexpr std::size_t kFewProducts = 3000;
// So many cells of a joint that is not algebraic are made of one of the first cells: what keeps contact all the time
// would be halved to the last depth everywhere.
constexpr std::size_t kMostCells = 8000;

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
    for (const RigidBody::Piece& piece : moving_.pieces()) moving_pieces_.emplace_back(piece);
    for (const RigidBody::Piece& piece : fixed_.pieces()) fixed_pieces_.emplace_back(piece);
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
        levels_.emplace(Pair{i, j},
                        RigidBody::of_set(transform(convex_hull(fixed_.pieces()[j].mesh.vertices),
                                                    AffineMap::translate({way * n[0], way * n[1], way * n[2]}))));
      }
    }
  }

  // The piece that stays, where it may overlap the other one of the pair.
  [[nodiscard]] const RigidBody::Piece& fixed_piece(const Pair& pair) const {
    const auto level = levels_.find(pair);
    return level == levels_.end() ? fixed_.pieces()[pair[1]] : level->second.pieces().front();
  }

  // Cells in order; `near` are the pairs that a wider cell left.
  void examine(const Rational& from, const Rational& to, const std::vector<Pair>* near, unsigned depth) {
    monitor_.check_interruption();
    ++result_.cells;
    cells_left_ -= std::min<std::size_t>(cells_left_, 1);
    const Joint::Sweep sweep = m_.joint.sweep(from, to, reach_);
    if (sweep.all.wide) {
      const Rational middle = (from + to) / 2;
      examine(from, middle, near, depth + 1);
      return examine(middle, to, near, depth + 1);
    }
    const std::vector<Pair> pairs = not_apart(sweep.all, near);
    if (pairs.empty()) return add_all(RangeStatus::kFree, from, to);
    std::vector<Pair> others = pairs;
    std::erase_if(others, [&](const Pair& pair) { return levels_.count(pair) > 0; });
    const bool may_overlap = !others.empty();
    if (all_collide(sweep, may_overlap ? others : pairs)) {
      return add_all(may_overlap ? RangeStatus::kColliding : RangeStatus::kTouching, from, to);
    }
    const bool algebraic = m_.joint.is_algebraic();
    std::size_t cost = 0;
    for (const Pair& pair : pairs) cost += event_cost(moving_pieces_[pair[0]], fixed_pieces_[pair[1]]);
    if (depth < (algebraic ? kDepth : kLastDepth) && (algebraic ? cost > kFewProducts : cells_left_ > 0)) {
      const Rational middle = (from + to) / 2;
      examine(from, middle, &pairs, depth + 1);
      examine(middle, to, &pairs, depth + 1);
    } else if (!algebraic) {
      add(RangeStatus::kUndecided, from, to, {});
    } else {
      find_events(from, to, pairs);
    }
  }

  // The pairs that may come nearer than doubles can tell in the cell.
  std::vector<Pair> not_apart(const MotionCell& cell, const std::vector<Pair>* near) {
    std::vector<Pair> result;
    const auto look_at = [&](const Pair& pair) {
      place(moving_.pieces()[pair[0]], cell, rough_moving_);
      place(fixed_piece(pair), rough_fixed_);
      if (plane_between(rough_moving_, rough_fixed_) != Separation::kApart) result.push_back(pair);
    };
    if (near != nullptr) {
      for (const Pair& pair : *near) look_at(pair);
    } else {
      any_close_leaf(cell, moving_, fixed_, root_pair(moving_, fixed_), [&](std::uint32_t a, std::uint32_t b) {
        look_at({a, b});
        return false;  // all of them
      });
    }
    return result;
  }

  // Do two pieces overlap at the middle, so deeply that they do in all of the cell?
  bool all_collide(const Joint::Sweep& sweep, const std::vector<Pair>& pairs) {
    for (const Pair& pair : pairs) {
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

  struct Event {
    QuadraticRoot value;
    std::vector<std::pair<Pair, ContactItems>> items;
  };

  // The value in doubles. A nearest double is off by 2^-53 of it, a root by as much again.
  static Interval enclosure_of(const QuadraticRoot& value) {
    const double rational = nearest_double(value.rational);
    const double root = value.sign * std::sqrt(nearest_double(value.square));
    return Interval::around(rational + root, 0x1p-50 * (std::fabs(rational) + std::fabs(root)) + MotionCell::kVanished);
  }

  std::vector<Event> events_in(const Rational& from, const Rational& to, const std::vector<Pair>& pairs) {
    struct Found {
      QuadraticRoot value;
      Interval rough;
      Pair pair;
      ContactItems items;
    };
    const EventCell cell(m_.joint, from, to);
    std::vector<Found> found;
    for (const Pair& pair : pairs) {
      std::vector<ContactEvent> of_pair;
      append_events(moving_pieces_[pair[0]], fixed_pieces_[pair[1]], cell, of_pair);
      for (ContactEvent& event : of_pair) {
        const Interval rough = enclosure_of(event.value);
        found.push_back({std::move(event.value), rough, pair, event.items});
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
      if (a.rough.high() < b.rough.low()) return true;
      if (b.rough.high() < a.rough.low()) return false;
      return compare(a.value, b.value) < 0;
    });
    std::vector<Event> events;
    for (Found& event : found) {
      if (events.empty() || compare(events.back().value, event.value) != 0) {
        events.push_back({std::move(event.value), {}});
      }
      events.back().items.emplace_back(event.pair, event.items);
    }
    result_.events += events.size();
    return events;
  }

  void find_events(const Rational& from, const Rational& to, const std::vector<Pair>& pairs) {
    std::vector<Event> events = events_in(from, to, pairs);
    // The cell's ends are events, too.
    if (events.empty() || compare(events.front().value, from) != 0) events.insert(events.begin(), Event{from, {}});
    if (compare(events.back().value, to) != 0) events.push_back({to, {}});
    std::vector<Rational> samples;
    std::vector<RangeStatus> between;
    for (std::size_t i = 0; i + 1 < events.size(); ++i) {
      samples.push_back(value_between(events[i].value, events[i + 1].value));
      between.push_back(status_at(samples.back()));
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
      const QuadraticRoot& value = events[i].value;
      const RangeStatus before = i == 0 ? between.front() : between[i - 1];
      const RangeStatus after = i + 1 == events.size() ? between.back() : between[i];
      const RangeStatus at = status_of(events[i], before, after, {pairs, samples[i == 0 ? 0 : i - 1]});
      const bool changes = at != before || at != after;
      add(at, value, value, changes ? stops_at(events[i]) : std::vector<ContactPair>{});
      if (i + 1 < events.size()) add(between[i], value, events[i + 1].value, {});
    }
  }

  static Rational value_between(const QuadraticRoot& a, const QuadraticRoot& b) {
    for (unsigned bits = 20;; bits *= 2) {
      const Rational low = enclosure(a, bits)[1];
      const Rational high = enclosure(b, bits)[0];
      if (low >= high) continue;
      const Rational room = (high - low) / 4;
      return simplest_between(low + room, high - room);
    }
  }

  // The pairs of a cell that may meet, and a value next to an event, with no event between the two.
  struct Beside {
    const std::vector<Pair>& pairs;
    const Rational& value;
  };

  // At the ends of the cell `before` or `after` is not known, and the other one stands for it: what follows from both
  // being equal is right then, too, since it is found by looking at the value itself.
  RangeStatus status_of(const Event& event, RangeStatus before, RangeStatus after, const Beside& beside) {
    if (event.items.empty()) return after;  // nothing changes
    const bool collides_before = before == RangeStatus::kColliding;
    const bool collides_after = after == RangeStatus::kColliding;
    if (collides_before && collides_after) {
      return overlap_at(event, beside) ? RangeStatus::kColliding : RangeStatus::kTouching;
    }
    if (before != RangeStatus::kFree || after != RangeStatus::kFree) return RangeStatus::kTouching;
    return touch_at(event) ? RangeStatus::kTouching : RangeStatus::kFree;
  }

  // Does a pair that has an event touch there? None overlaps next to it.
  bool touch_at(const Event& event) {
    std::vector<Pair> concerned;
    for (const auto& [pair, items] : event.items) concerned.push_back(pair);
    concerned.erase(std::unique(concerned.begin(), concerned.end()), concerned.end());
    const std::vector<Pair> open = not_apart(m_.joint.sweep(event.value).all, &concerned);
    return std::any_of(open.begin(), open.end(), [&](const Pair& pair) {
      return PlacedPiece(moving_pieces_[pair[0]], m_.joint, event.value).touches(fixed_pieces_[pair[1]]);
    });
  }

  // Does a pair of the cell overlap at an event, next to which some pairs do?
  bool overlap_at(const Event& event, const Beside& beside) {
    const Joint::Sweep sweep = m_.joint.sweep(event.value);
    if (all_collide(sweep, beside.pairs)) return true;
    const std::vector<Pair> open = not_apart(sweep.all, &beside.pairs);
    return std::any_of(open.begin(), open.end(), [&](const Pair& pair) {
      if (!overlap_at(beside.value, pair)) return false;
      const PlacedPiece placed(moving_pieces_[pair[0]], m_.joint, event.value);
      return std::none_of(event.items.begin(), event.items.end(), [&](const auto& item) {
        return item.first == pair && placed.is_between(fixed_pieces_[pair[1]], item.second);
      });
    });
  }

  // Exactly.
  bool overlap_at(const Rational& value, const Pair& pair) const {
    const RigidPose pose = m_.joint.pose(value);
    const Matrix3 turn = rotation_between(pose.quaternion, pose.quaternion);
    std::vector<Rational3> placed;
    for (const Rational3& x : moving_pieces_[pair[0]].vertices()) {
      placed.push_back(
          {dot(turn[0], x) + pose.position[0], dot(turn[1], x) + pose.position[1], dot(turn[2], x) + pose.position[2]});
    }
    return !hulls_are_apart(placed, fixed_pieces_[pair[1]].vertices(), false);
  }

  std::vector<ContactPair> stops_at(const Event& event) {
    std::vector<ContactPair> result;
    std::optional<std::pair<std::uint32_t, PlacedPiece>> placed;
    for (const auto& [pair, items] : event.items) {
      if (!placed || placed->first != pair[0]) {
        placed.emplace(pair[0], PlacedPiece(moving_pieces_[pair[0]], m_.joint, event.value));
      }
      const ContactPiece& fixed = fixed_pieces_[pair[1]];
      if (!placed->second.touch(fixed, items)) continue;
      using Kind = ContactItems::Kind;
      const std::size_t owner = owners_[pair[1]];
      ContactPair stop{
          name_of(sets_.moving, place_of(moving_pieces_[pair[0]], items.moving, items.kind == Kind::kVertexFace,
                                         items.kind == Kind::kFaceVertex)),
          owner,
          name_of(sets_.fixed[owner],
                  place_of(fixed, items.fixed, items.kind == Kind::kFaceVertex, items.kind == Kind::kVertexFace))};
      const auto same = [&](const ContactPair& other) {
        return other.moving == stop.moving && other.fixed == stop.fixed && other.of_fixed == stop.of_fixed;
      };
      if (std::none_of(result.begin(), result.end(), same)) result.push_back(std::move(stop));
    }
    return result;
  }

  // A point inside an item of a piece.
  static Rational3 place_of(const ContactPiece& piece, std::uint32_t item, bool is_vertex, bool is_face) {
    if (is_vertex) return piece.vertices()[item];
    std::vector<std::uint32_t> corners;
    if (is_face) {
      corners = piece.faces[item].ring;
    } else {
      corners = {piece.edges[item].from, piece.edges[item].to};
    }
    Rational3 middle;
    for (const std::uint32_t corner : corners) {
      for (std::size_t k = 0; k < 3; ++k) middle[k] += piece.vertices()[corner][k] / Rational(corners.size());
    }
    return middle;
  }

  // The cell of the set that a point is in: pieces have vertices, edges and faces where the set has none.
  static std::string name_of(const Polyhedron& set, const Rational3& point) {
    const Location at = locate(set, point);
    return std::string(location_name(at.kind)) + " " + std::to_string(at.index);
  }

  void add_all(RangeStatus status, const Rational& from, const Rational& to) {
    add(status, from, from, {});
    add(status, from, to, {});
    add(status, to, to, {});
  }

  // Appends an open interval, or a value, to what is known.
  void add(RangeStatus status, const QuadraticRoot& from, const QuadraticRoot& to, std::vector<ContactPair> stops) {
    std::vector<RangePart>& parts = result_.parts;
    const bool is_value = compare(from, to) == 0;
    if (!parts.empty() && parts.back().status == status) {
      parts.back().to = {to, std::move(stops)};
      return;
    }
    RangePart part;
    part.status = status;
    part.from.value = from;
    part.to.value = to;
    if (is_value) part.from.stops = part.to.stops = std::move(stops);
    parts.push_back(std::move(part));
  }

  const Mechanism& m_;
  Monitor monitor_;
  Shifted sets_;
  std::vector<std::size_t> owners_;  // of pieces of the others
  RigidBody moving_;
  RigidBody fixed_;
  MotionChecker allowing_;
  MotionChecker forbidding_;
  std::vector<ContactPiece> moving_pieces_;
  std::vector<ContactPiece> fixed_pieces_;
  std::map<Rational, RangeStatus> known_;
  std::map<Pair, RigidBody> levels_;  // of pairs that have only a plane across the axis in common: the piece that stays
  std::size_t cells_left_ = 0;
  double reach_ = 0;  // of the moving part, from the joint's turning point
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

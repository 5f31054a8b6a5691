// SPDX-License-Identifier: Apache-2.0
//
// Robots of boxes and prisms that turn freely among boxes and prisms: in the open, before walls with windows, in
// chambers. The oracle works in doubles, with the planes of faces and of pairs of edges. Two poses that are both so far
// from the obstacles that no point of the robot gets there on its way from one to the other make a way that surely is
// there. A ball inside of the robot is a robot that cannot be hindered by turning: where it finds no way through a fine
// grid of cubes, there surely is none.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/planner/rigid_search/rigid_planning.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/geometry/vectors.h"

namespace nef::fuzz {
namespace {

using planner::RigidAnswer;
using Spot = Eigen::Vector3d;

constexpr int kRoomSide = 6;  // the reference point is in the cube from 0 to this
constexpr double kRoundOff = 1e-8;

Rational eighths(int x) {
  Rational r(x, 8);
  r.canonicalize();
  return r;
}

Spot spot_of(const Rational3& p) { return {nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])}; }

// Where a body is, in doubles.
struct Placing {
  Spot position{0, 0, 0};
  Eigen::Quaterniond turn{1, 0, 0, 0};
};

Eigen::Quaterniond unit_of(const planner::Quaternion& q) {
  return Eigen::Quaterniond(nearest_double(q[0]), nearest_double(q[1]), nearest_double(q[2]), nearest_double(q[3]))
      .normalized();
}

// What a prism over a convex polygon looks like where it is.
struct PrismBody {
  std::vector<Spot> points;
  std::vector<Spot> normals;  // outward
  std::vector<Spot> edges;    // directions
  Spot middle{0, 0, 0};
  double radius = 0;  // around the middle
  double inner = 0;   // of a ball about the middle that is inside
};

// A prism, and the map that took it to its place.
struct PlacedPrism {
  std::vector<std::array<double, 2>> polygon;  // counterclockwise
  double low = 0, high = 0;
  Placing placed;
  PrismBody body;
  std::vector<Rational3> vertices;

  // The distance of a point.
  [[nodiscard]] double distance(const Spot& point) const {
    const Spot p = placed.turn.conjugate() * (point - placed.position);
    double beside = 0;
    bool inside = true;
    double nearest = HUGE_VAL;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d a(polygon[i][0], polygon[i][1]);
      const std::array<double, 2>& next = polygon[(i + 1) % polygon.size()];
      const Eigen::Vector2d along = Eigen::Vector2d(next[0], next[1]) - a;
      const Eigen::Vector2d to = p.head<2>() - a;
      inside = inside && along[0] * to[1] - along[1] * to[0] >= 0;
      const double share = std::clamp(to.dot(along) / along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (to - share * along).norm());
    }
    if (!inside) beside = nearest;
    return std::hypot(beside, std::max({low - p[2], p[2] - high, 0.0}));
  }
};

PrismBody turned_body(const PrismBody& body, const Placing& at) {
  const Eigen::Matrix3d turn = at.turn.toRotationMatrix();
  PrismBody result;
  for (const Spot& p : body.points) result.points.emplace_back(turn * p + at.position);
  for (const Spot& n : body.normals) result.normals.emplace_back(turn * n);
  for (const Spot& e : body.edges) result.edges.emplace_back(turn * e);
  result.middle = turn * body.middle + at.position;
  result.radius = body.radius;
  return result;
}

// How far the points of b are beyond those of a in a direction.
double gap_along(const Spot& n, const PrismBody& a, const PrismBody& b) {
  double most = -HUGE_VAL;
  double least = HUGE_VAL;
  for (const Spot& p : a.points) most = std::max(most, n.dot(p));
  for (const Spot& p : b.points) least = std::min(least, n.dot(p));
  return least - most;
}

// No more than the distance of both; where they overlap, minus the depth.
double room_between(const PrismBody& a, const PrismBody& b) {
  const double far = (a.middle - b.middle).norm() - a.radius - b.radius;
  if (far > 1) return far;
  double best = -HUGE_VAL;
  for (const Spot& n : a.normals) best = std::max(best, gap_along(n, a, b));
  for (const Spot& n : b.normals) best = std::max(best, gap_along(n, b, a));
  for (const Spot& e : a.edges) {
    for (const Spot& g : b.edges) {
      const Spot n = e.cross(g);
      const double length = n.norm();
      if (length < 1e-6) continue;
      best = std::max({best, gap_along(n / length, a, b), gap_along(-n / length, a, b)});
    }
  }
  return best;
}

// Rotations on a grid: points of the boundary of a cube in four dimensions with whole coordinates, opposite ones once.
class TurnGrid {
 public:
  using Whole = std::array<int, 4>;
  static const TurnGrid& instance() {
    static const TurnGrid grid;
    return grid;
  }
  [[nodiscard]] std::size_t size() const { return turns_.size(); }
  [[nodiscard]] const Whole& operator[](std::size_t i) const { return turns_[i]; }
  [[nodiscard]] const std::vector<std::size_t>& neighbours(std::size_t i) const { return neighbours_[i]; }

 private:
  TurnGrid() {
    constexpr int kFar = 2;
    for (int w = -kFar; w <= kFar; ++w) {
      for (int x = -kFar; x <= kFar; ++x) {
        for (int y = -kFar; y <= kFar; ++y) {
          for (int z = -kFar; z <= kFar; ++z) add({w, x, y, z}, kFar);
        }
      }
    }
    // The rotation that is none first: zero stands for the simplest case.
    std::swap(turns_.front(), *std::find(turns_.begin(), turns_.end(), Whole{kFar, 0, 0, 0}));
    neighbours_.resize(turns_.size());
    for (std::size_t i = 0; i < turns_.size(); ++i) {
      for (std::size_t j = 0; j < turns_.size(); ++j) {
        if (i != j && (are_near(turns_[i], turns_[j], 1) || are_near(turns_[i], turns_[j], -1))) {
          neighbours_[i].push_back(j);
        }
      }
    }
  }
  void add(const Whole& q, int far) {
    const auto first = std::find_if(q.begin(), q.end(), [&](int x) { return std::abs(x) == far; });
    if (first != q.end() && *first > 0) turns_.push_back(q);
  }
  static bool are_near(const Whole& p, const Whole& q, int sign) {
    int steps = 0;
    for (std::size_t k = 0; k < 4; ++k) steps += std::abs(p[k] - sign * q[k]);
    return steps <= 1;
  }
  std::vector<Whole> turns_;
  std::vector<std::vector<std::size_t>> neighbours_;
};

class RigidPathCase {
 public:
  explicit RigidPathCase(const Case& the_case) : case_(the_case) { draw(); }

  void run() {
    using Status = RigidAnswer::Status;
    const planner::MotionChecker checker = planner::MotionChecker::of_scene(scene_);
    const RigidAnswer answer =
        planner::find_rigid_path(scene_, checker, {.max_slices = 10, .max_samples = 1000, .max_boxes = 6000});
    check_end(answer.status == Status::kInvalidStart, start_, "start");
    if (answer.status == Status::kInvalidStart) return case_.count("invalid");
    check_end(answer.status == Status::kInvalidGoal, goal_, "goal");
    if (answer.status == Status::kInvalidGoal) return case_.count("invalid");
    if (answer.status == Status::kPath) {
      check_path(answer, checker);
      case_.count("paths");
    } else if (answer.status == Status::kInfeasible) {
      check_proof(answer);
      case_.count("proofs");
    } else {
      case_.count("undecided");
      if (has_way(300)) case_.count("undecided where there is a way");
    }
  }

 private:
  // A pose of the grid: positions are halves.
  struct GridPlace {
    std::array<int, 3> position{};
    std::size_t turn = 0;
    bool operator==(const GridPlace& other) const { return position == other.position && turn == other.turn; }
  };

  // ----- what is asked

  PlacedPrism random_prism(const std::array<int, 3>& low, const std::array<int, 3>& size, bool triangle,
                           int turn) const {
    PlacedPrism prism;
    const auto at = [&](std::size_t k, int share) { return eighths(low[k] + share * size[k]); };
    std::vector<std::array<Rational, 2>> polygon{{at(0, 0), at(1, 0)}, {at(0, 1), at(1, 0)}, {at(0, 1), at(1, 1)}};
    if (!triangle) polygon.push_back({at(0, 0), at(1, 1)});
    static const std::array<planner::Quaternion, 8> kTurns{{{1, 0, 0, 0},
                                                            {3, 1, 0, 0},
                                                            {2, 0, 1, 0},
                                                            {4, 1, 0, 1},
                                                            {3, 1, 1, 1},
                                                            {1, 0, 0, 1},
                                                            {2, 1, -1, 0},
                                                            {5, -2, 1, 1}}};
    // It turns about its middle.
    const planner::Quaternion& q = kTurns[static_cast<std::size_t>(turn)];
    Rational3 middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (at(k, 0) + at(k, 1)) / 2;
    const AffineMap about = planner::map_of({{}, q});
    const Rational3 turned_middle = about(middle);
    const planner::RigidPose pose{minus(middle, turned_middle), q};
    const AffineMap map = planner::map_of(pose);
    for (const auto& p : polygon) {
      prism.polygon.push_back({nearest_double(p[0]), nearest_double(p[1])});
      for (const int end : {0, 1}) prism.vertices.push_back(map({p[0], p[1], at(2, end)}));
    }
    prism.low = nearest_double(at(2, 0));
    prism.high = nearest_double(at(2, 1));
    prism.placed = {spot_of(pose.position), unit_of(q)};
    fill_body(prism);
    std::string text = "prism of";
    for (const Rational3& v : prism.vertices) {
      text += " (" + to_string(v[0]) + "," + to_string(v[1]) + "," + to_string(v[2]) + ")";
    }
    case_.tell(text);
    return prism;
  }

  static void fill_body(PlacedPrism& prism) {
    PrismBody& body = prism.body;
    for (const Rational3& v : prism.vertices) body.points.push_back(spot_of(v));
    const Eigen::Matrix3d turn = prism.placed.turn.toRotationMatrix();
    for (std::size_t i = 0; i < prism.polygon.size(); ++i) {
      const std::array<double, 2>& a = prism.polygon[i];
      const std::array<double, 2>& b = prism.polygon[(i + 1) % prism.polygon.size()];
      const Spot along = Spot(b[0] - a[0], b[1] - a[1], 0).normalized();
      body.edges.emplace_back(turn * along);
      body.normals.emplace_back(turn * Spot(along[1], -along[0], 0));
    }
    body.edges.emplace_back(turn * Spot(0, 0, 1));
    body.normals.emplace_back(turn * Spot(0, 0, 1));
    body.normals.emplace_back(turn * Spot(0, 0, -1));
    for (const Spot& p : body.points) body.middle += p / static_cast<double>(body.points.size());
    for (const Spot& p : body.points) body.radius = std::max(body.radius, (p - body.middle).norm());
    body.inner = HUGE_VAL;
    for (const Spot& n : body.normals) {
      double most = -HUGE_VAL;
      for (const Spot& p : body.points) most = std::max(most, n.dot(p));
      body.inner = std::min(body.inner, most - n.dot(body.middle));
    }
  }

  void draw_robot() {
    Choices& choices = case_.choices();
    const std::array<int, 3> size{choices.between(3, 14), choices.between(3, 12), choices.between(3, 8)};
    thinnest_ = *std::min_element(size.begin(), size.end());
    std::array<int, 3> low{};
    for (std::size_t k = 0; k < 3; ++k) low[k] = choices.one_in(3) ? choices.between(-8, 4) : -size[k] / 2;
    case_.tell("robot");
    robot_.push_back(random_prism(low, size, choices.one_in(4), 0));
    if (!choices.one_in(2)) return;
    // An arm, which begins at the first piece.
    std::array<int, 3> arm{size};
    std::array<int, 3> from{low};
    const std::size_t k = choices.below(3);
    arm[k] = std::max(1, size[k] / 2);
    const std::size_t along = (k + 1 + choices.below(2)) % 3;
    arm[along] = size[along] + choices.between(1, 12);
    if (choices.one_in(2)) from[k] += size[k] - arm[k];
    robot_.push_back(random_prism(from, arm, choices.one_in(4), 0));
  }

  // A slab across x, with a window in it.
  void add_wall(int x) {
    Choices& choices = case_.choices();
    const int thick = choices.between(1, 6);
    // A third of the windows is so narrow that a proof should be found.
    const int most = choices.one_in(3) ? std::max(1, thinnest_ / 2) : 20;
    const int least = std::min(2, most);
    const std::array<int, 2> size{choices.between(least, most), choices.between(least, most)};
    const std::array<int, 2> at{choices.between(0, 40 - size[0]), choices.between(0, 40 - size[1])};
    constexpr int kOut = 60;  // beyond all that the robot can reach past the room
    const int side = 8 * kRoomSide + 2 * kOut;
    obstacles_.push_back(random_prism({x, -kOut, -kOut}, {thick, at[0] + kOut, side}, false, 0));
    obstacles_.push_back(
        random_prism({x, at[0] + size[0], -kOut}, {thick, side - kOut - at[0] - size[0], side}, false, 0));
    obstacles_.push_back(random_prism({x, at[0], -kOut}, {thick, size[0], at[1] + kOut}, false, 0));
    obstacles_.push_back(
        random_prism({x, at[0], at[1] + size[1]}, {thick, size[0], side - kOut - at[1] - size[1]}, false, 0));
  }

  // Six slabs around the start, one of them perhaps shorter.
  void add_chamber(const std::array<int, 3>& middle) {
    Choices& choices = case_.choices();
    const std::array<int, 3> half{choices.between(6, 20), choices.between(6, 20), choices.between(6, 20)};
    const int thick = choices.between(2, 8);
    const std::uint32_t open = choices.below(12);
    for (std::size_t side = 0; side < 6; ++side) {
      const std::size_t k = side / 2;
      std::array<int, 3> low{};
      std::array<int, 3> size{};
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = middle[i] - half[i] - thick;
        size[i] = 2 * half[i] + 2 * thick;
      }
      size[k] = thick;
      if (side % 2 == 1) low[k] = middle[k] + half[k];
      const std::size_t other = (k + 1) % 3;
      if (side == open) size[other] -= std::min(size[other] - 1, choices.between(1, 24));
      obstacles_.push_back(random_prism(low, size, false, 0));
    }
  }

  void draw_obstacles() {
    Choices& choices = case_.choices();
    case_.tell("obstacles");
    const std::uint32_t kind = choices.below(5);
    const bool walls = kind == 1 || kind == 2;
    if (walls) add_wall(choices.between(18, 22));
    if (kind == 2) add_wall(choices.between(28, 34));
    if (kind == 3) add_chamber({4 * start_.position[0], 4 * start_.position[1], 4 * start_.position[2]});
    for (std::uint32_t i = choices.below(kind == 0 ? 6 : 3); i > 0; --i) {
      std::array<int, 3> low{};
      std::array<int, 3> size{};
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = choices.between(0, 40);
        size[k] = choices.between(1, 20);
      }
      obstacles_.push_back(random_prism(low, size, choices.one_in(3), static_cast<int>(choices.below(8))));
    }
    has_box_ = walls || choices.one_in(2);
  }

  GridPlace random_place(int low_x, int high_x) {
    Choices& choices = case_.choices();
    return {{choices.between(low_x, high_x), choices.between(0, 2 * kRoomSide), choices.between(0, 2 * kRoomSide)},
            choices.below(static_cast<std::uint32_t>(TurnGrid::instance().size()))};
  }

  void draw() {
    Choices& choices = case_.choices();
    draw_robot();
    start_ = random_place(0, 4);
    goal_ = random_place(9, 2 * kRoomSide);
    draw_obstacles();
    // Most poses that collide are drawn again.
    for (int i = 0; i < 8 && room_at(placing_of(start_)) <= 0; ++i) start_ = random_place(0, 4);
    for (int i = 0; i < 8 && room_at(placing_of(goal_)) <= 0; ++i) goal_ = random_place(9, 2 * kRoomSide);
    if (choices.one_in(5)) shift_ = {Rational(1000003, 3), Rational(-77777, 7), Rational(12345)};
    if (choices.one_in(4)) scene_.contact = planner::ContactRule::kForbid;
    std::vector<Polyhedron> parts;
    for (const PlacedPrism& prism : robot_) parts.push_back(convex_hull(prism.vertices));
    scene_.robot = unite_all(parts);
    std::vector<Polyhedron> solids;
    for (const PlacedPrism& prism : obstacles_) {
      solids.push_back(transform(convex_hull(prism.vertices), AffineMap::translate(shift_)));
    }
    if (choices.one_in(2) && !solids.empty()) solids = {unite_all(solids)};
    scene_.obstacles = std::move(solids);
    scene_.obstacle_names.resize(scene_.obstacles.size(), "obstacle");
    if (has_box_) scene_.box = {{shift_, plus(shift_, Rational3{kRoomSide, kRoomSide, kRoomSide})}};
    scene_.turns_freely = true;
    scene_.start = position_of(start_);
    scene_.goal = position_of(goal_);
    scene_.quaternions = {{quaternion_of(start_), quaternion_of(goal_)}};
    case_.tell("start " + text_of(start_) + ", goal " + text_of(goal_) + ", shift by " + to_string(shift_[0]) + " " +
               to_string(shift_[1]) + " " + to_string(shift_[2]) + (has_box_ ? ", box 0 to 6" : ", no box") +
               (scene_.contact == planner::ContactRule::kForbid ? ", contact forbidden" : ""));
  }

  [[nodiscard]] Rational3 position_of(const GridPlace& place) const {
    Rational3 result = shift_;
    for (std::size_t k = 0; k < 3; ++k) result[k] += eighths(4 * place.position[k]);
    return result;
  }
  [[nodiscard]] static planner::Quaternion quaternion_of(const GridPlace& place) {
    const TurnGrid::Whole& q = TurnGrid::instance()[place.turn];
    return {q[0], q[1], q[2], q[3]};
  }
  [[nodiscard]] static std::string text_of(const GridPlace& place) {
    std::string text;
    for (const int x : place.position) text += std::to_string(x) + "/2 ";
    for (const int x : TurnGrid::instance()[place.turn]) text += " " + std::to_string(x);
    return text;
  }

  // ----- the oracle

  [[nodiscard]] static Placing placing_of(const GridPlace& place) {
    return {{place.position[0] / 2.0, place.position[1] / 2.0, place.position[2] / 2.0}, unit_of(quaternion_of(place))};
  }

  [[nodiscard]] double room_at(const Placing& at) const {
    double room = HUGE_VAL;
    for (const PlacedPrism& piece : robot_) {
      const PrismBody there = turned_body(piece.body, at);
      for (const PlacedPrism& obstacle : obstacles_) room = std::min(room, room_between(there, obstacle.body));
    }
    return room;
  }

  void check_end(bool refused, const GridPlace& place, const std::string& name) const {
    const double room = room_at(placing_of(place));
    Case::require(!(refused && room > kRoundOff), name + ": refused, and it surely is free");
    Case::require(refused || room > -kRoundOff, name + ": taken, and it surely is not free");
  }

  void check_path(const RigidAnswer& answer, const planner::MotionChecker& checker) const {
    const std::vector<planner::RigidPose>& path = answer.path;
    Case::require(path.size() >= 2 && path.front().position == *scene_.start && path.back().position == *scene_.goal &&
                      path.front().quaternion == (*scene_.quaternions)[0] &&
                      path.back().quaternion == (*scene_.quaternions)[1],
                  "path: wrong ends");
    std::uint64_t poses = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      Case::require(planner::is_in_box(path[i].position, scene_.box), "path: leaves the box");
      const Placing from{spot_of(minus(path[i].position, shift_)), unit_of(path[i].quaternion)};
      const Placing to{spot_of(minus(path[i + 1].position, shift_)), unit_of(path[i + 1].quaternion)};
      constexpr int kPosesOfMotion = 40;
      for (int k = 0; k <= kPosesOfMotion; ++k, ++poses) {
        const double room = room_at(between(from, to, k / double{kPosesOfMotion}));
        Case::require(room > -kRoundOff, "path: motion " + std::to_string(i) + " meets an obstacle");
      }
    }
    case_.count("poses of paths", poses);
    for (const PlacedPrism& piece : robot_) {
      if (ball_is_held(piece.body)) throw Failure("reachable: a path where a ball in the robot has none");
    }
    const auto proof = planner::make_path_proof(checker, path);
    Case::require(proof.has_value(), "proof: a certified path has none");
    const auto complaint = planner::complaint_about(*proof);
    Case::require(!complaint, "proof: " + complaint.value_or(""));
  }

  void check_proof(const RigidAnswer& answer) {
    Case::require(answer.proof.has_value(), "proof: there is none");
    const auto complaint = planner::complaint_about(*answer.proof);
    Case::require(!complaint, "proof: " + complaint.value_or(""));
    const auto difference = planner::complaint_about(answer.proof->claim, scene_);
    Case::require(!difference, "proof: " + difference.value_or(""));
    Case::require(!has_way(3000), "reachable: a proof where there surely is a path");
  }

  static Placing between(const Placing& from, const Placing& to, double share) {
    return {from.position + share * (to.position - from.position), from.turn.slerp(share, to.turn)};
  }

  // No point of the robot gets farther than this from one pose to another.
  [[nodiscard]] double way_of(const Placing& from, const Placing& to) const {
    double reach = 0;
    for (const PlacedPrism& piece : robot_) reach = std::max(reach, piece.body.middle.norm() + piece.body.radius);
    return (to.position - from.position).norm() + reach * from.turn.angularDistance(to.turn);
  }

  // Both ends have room.
  [[nodiscard]] bool surely_moves(const Placing& from, double room_from, const Placing& to, double room_to,
                                  int depth) const {
    if (room_from + room_to > way_of(from, to) + kRoundOff) return true;
    if (depth == 0) return false;
    const Placing middle = between(from, to, 0.5);
    const double room = room_at(middle);
    return room > kRoundOff && surely_moves(from, room_from, middle, room, depth - 1) &&
           surely_moves(middle, room, to, room_to, depth - 1);
  }

  // A way over poses of the grid from start to goal, looked for with so many poses.
  [[nodiscard]] bool has_way(std::size_t most) const {
    const auto cost = [&](const GridPlace& place) { return way_of(placing_of(place), placing_of(goal_)); };
    std::unordered_map<std::uint64_t, double> rooms;
    const auto key = [](const GridPlace& place) {
      std::uint64_t result = place.turn;
      for (const int x : place.position) result = result * 16 + static_cast<std::uint64_t>(x);
      return result;
    };
    using Open = std::pair<double, GridPlace>;
    const auto later = [](const Open& a, const Open& b) { return a.first > b.first; };
    std::priority_queue<Open, std::vector<Open>, decltype(later)> open(later);
    open.emplace(cost(start_), start_);
    rooms.emplace(key(start_), room_at(placing_of(start_)));
    if (rooms.begin()->second <= kRoundOff) return false;
    for (std::size_t steps = 0; !open.empty() && steps < most; ++steps) {
      const GridPlace at = open.top().second;
      open.pop();
      if (at == goal_) return true;
      const double room_here = rooms.at(key(at));
      for (const GridPlace& next : neighbours(at)) {
        if (rooms.count(key(next)) > 0) continue;
        const double room = room_at(placing_of(next));
        constexpr int kHalvings = 4;
        if (room > kRoundOff && !surely_moves(placing_of(at), room_here, placing_of(next), room, kHalvings)) continue;
        rooms.emplace(key(next), room);
        if (room > kRoundOff) open.emplace(cost(next), next);
      }
    }
    return false;
  }

  [[nodiscard]] static std::vector<GridPlace> neighbours(const GridPlace& at) {
    std::vector<GridPlace> result;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const int step : {-1, 1}) {
        GridPlace next = at;
        next.position[k] += step;
        if (next.position[k] >= 0 && next.position[k] <= 2 * kRoomSide) result.push_back(next);
      }
    }
    for (const std::size_t turn : TurnGrid::instance().neighbours(at.turn)) result.push_back({at.position, turn});
    return result;
  }

  // ----- a ball in the robot

  static constexpr int kCubesOfUnit = 8;
  static constexpr int kCubeBegin = -2 * kCubesOfUnit;
  static constexpr int kCubes = (kRoomSide + 4) * kCubesOfUnit;  // along each axis

  using Cube = std::array<int, 3>;
  [[nodiscard]] static std::size_t index_of(const Cube& cube) {
    const auto at = [&cube](std::size_t axis) { return static_cast<std::size_t>(cube[axis]); };
    return (at(2) * kCubes + at(1)) * kCubes + at(0);
  }
  [[nodiscard]] static bool is_inside(const Cube& cube) {
    return std::all_of(cube.begin(), cube.end(), [](int x) { return x >= 0 && x < kCubes; });
  }
  [[nodiscard]] static Cube cube_of(const Spot& p) {
    Cube cube{};
    for (std::size_t k = 0; k < 3; ++k) {
      cube[k] = static_cast<int>(std::floor(p[static_cast<Eigen::Index>(k)] * kCubesOfUnit)) - kCubeBegin;
    }
    return cube;
  }

  // Has the ball inside of a piece no way from start to goal?
  [[nodiscard]] bool ball_is_held(const PrismBody& piece) const {
    const Placing start = placing_of(start_);
    const Placing goal = placing_of(goal_);
    const Cube from = cube_of(start.turn * piece.middle + start.position);
    const Cube to = cube_of(goal.turn * piece.middle + goal.position);
    if (!is_inside(from) || !is_inside(to)) return false;
    // Every cube is looked at when it is reached, from the start. What is outside is one place.
    std::vector<char> seen(static_cast<std::size_t>(kCubes) * kCubes * kCubes, 0);
    std::vector<Cube> open{from};
    seen[index_of(from)] = 1;
    while (!open.empty()) {
      const Cube at = open.back();
      open.pop_back();
      if (at == to) return false;
      for (int code = 0; code < 27; ++code) {
        const Cube next{at[0] + code % 3 - 1, at[1] + code / 3 % 3 - 1, at[2] + code / 9 - 1};
        if (!is_inside(next)) return false;  // perhaps there is a way outside
        if (seen[index_of(next)] != 0) continue;
        seen[index_of(next)] = 1;
        if (next == to || !is_blocked(next, piece)) open.push_back(next);
      }
    }
    return true;
  }

  // Is the ball surely in the way of something wherever in the cube its centre is?
  [[nodiscard]] bool is_blocked(const Cube& cube, const PrismBody& piece) const {
    Spot middle;
    for (Eigen::Index k = 0; k < 3; ++k) {
      middle[k] = (cube[static_cast<std::size_t>(k)] + kCubeBegin + 0.5) / kCubesOfUnit;
    }
    const double half = std::sqrt(0.75) / kCubesOfUnit + kRoundOff;
    if (has_box_) {
      double square = 0;
      for (Eigen::Index k = 0; k < 3; ++k) {
        const double out = std::max({-middle[k], middle[k] - kRoomSide, 0.0});
        square += out * out;
      }
      if (std::sqrt(square) - half > piece.middle.norm()) return true;
    }
    if (piece.inner <= half) return false;
    return std::any_of(obstacles_.begin(), obstacles_.end(),
                       [&](const PlacedPrism& obstacle) { return obstacle.distance(middle) < piece.inner - half; });
  }

  const Case& case_;
  planner::Scene scene_;
  std::vector<PlacedPrism> robot_;
  std::vector<PlacedPrism> obstacles_;
  Rational3 shift_{0, 0, 0};
  GridPlace start_;
  GridPlace goal_;
  bool has_box_ = false;
  int thinnest_ = 0;  // the shortest edge of the robot's first piece, in eighths
};

}  // namespace

void fuzz_rigid_paths(const Case& the_case) { RigidPathCase(the_case).run(); }

}  // namespace nef::fuzz

// SPDX-License-Identifier: Apache-2.0
//
// Flat robots that turn among flat obstacles, in a plane that lies anywhere in space. The oracle works in the plane, in
// doubles: how far a robot and an obstacle are apart, or how deep in each other, at the poses of a fine grid. Poses
// next to each other that are both farther apart than a step takes any point make ways that are surely there; without
// poses that are less deep than a step, there surely is no way.
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <vector>

#include "apps/planner/turning/turning_search.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"

namespace nef::fuzz {
namespace {

using planner::ContactRule;
using planner::Pose;
using planner::TurningAnswer;

using Polygon = std::vector<std::array<Rational, 2>>;  // convex, counterclockwise
using Point2 = std::array<double, 2>;

constexpr int kSide = 8;         // the reference point is in the square from 0 to this
constexpr int kStepsOfUnit = 8;  // of the grid
constexpr int kPositions = kSide * kStepsOfUnit + 1;
constexpr int kAngles = 128;  // of the range

Rational quarters(int x) {
  Rational r(x, 4);
  r.canonicalize();
  return r;
}

Polygon rectangle(const Rational& x, const Rational& y, const Rational& to_x, const Rational& to_y) {
  return {{x, y}, {to_x, y}, {to_x, to_y}, {x, to_y}};
}

// Turned by the angle of 3-4-5 about a point, or not.
Polygon turned(Polygon polygon, const std::array<Rational, 2>& about, int how) {
  if (how == 0) return polygon;
  const Rational c = Rational(how == 1 ? 4 : 3, 5);
  const Rational s = Rational(how == 1 ? 3 : 4, 5);
  for (auto& p : polygon) {
    const Rational x = p[0] - about[0];
    const Rational y = p[1] - about[1];
    p = {about[0] + c * x - s * y, about[1] + s * x + c * y};
  }
  return polygon;
}

struct Shape {
  std::vector<Point2> points;
  Point2 middle{};
  double radius = 0;
};

Shape shape_of(std::vector<Point2> points) {
  Shape shape{std::move(points)};
  for (const Point2& p : shape.points) {
    for (std::size_t k = 0; k < 2; ++k) shape.middle[k] += p[k] / static_cast<double>(shape.points.size());
  }
  for (const Point2& p : shape.points) {
    shape.radius = std::max(shape.radius, std::hypot(p[0] - shape.middle[0], p[1] - shape.middle[1]));
  }
  return shape;
}

Shape shape_of(const Polygon& polygon) {
  std::vector<Point2> points;
  for (const auto& p : polygon) points.push_back({nearest_double(p[0]), nearest_double(p[1])});
  return shape_of(std::move(points));
}

// By how much the sides of a keep b away: the depth, negative, where all of them fail.
double kept_away(const Shape& a, const Shape& b) {
  double best = -HUGE_VAL;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const Point2& p = a.points[i];
    const Point2& q = a.points[(i + 1) % a.points.size()];
    const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
    const Point2 normal{(q[1] - p[1]) / length, (p[0] - q[0]) / length};
    double least = HUGE_VAL;
    for (const Point2& r : b.points) least = std::min(least, normal[0] * (r[0] - p[0]) + normal[1] * (r[1] - p[1]));
    best = std::max(best, least);
  }
  return best;
}

// No more than their distance; where they overlap, minus the depth.
double apart(const Shape& a, const Shape& b) {
  const double middles = std::hypot(a.middle[0] - b.middle[0], a.middle[1] - b.middle[1]);
  const double far = middles - a.radius - b.radius;
  return far > 1 ? far : std::max(kept_away(a, b), kept_away(b, a));
}

class TurningCase {
 public:
  explicit TurningCase(const Case& the_case) : case_(the_case) { draw(); }

  void run() {
    const TurningAnswer answer = planner::find_turning_path(scene_, question_, {.max_cells = 40});
    for (const Polygon& polygon : robot_) robot_shapes_.push_back(shape_of(polygon));
    for (const Polygon& polygon : obstacles_) obstacle_shapes_.push_back(shape_of(polygon));
    using Status = TurningAnswer::Status;
    check_end(answer.status == Status::kInvalidStart, start_, "start");
    if (answer.status == Status::kInvalidStart) return case_.count("invalid");
    check_end(answer.status == Status::kInvalidGoal, goal_, "goal");
    if (answer.status == Status::kInvalidGoal) return case_.count("invalid");
    if (answer.status == Status::kUndecided) return case_.count("undecided");
    fill_grid();
    const Node start = node_of(start_);
    const Node goal = node_of(goal_);
    if (answer.status == Status::kPath) {
      Case::require(reaches(start, goal, -deepest(), true), "reachable: a path where there surely is none");
      check_path(answer);
      case_.count("paths");
    } else {
      Case::require(!reaches(start, goal, widest_step(), false), "reachable: a proof where there surely is a path");
      const auto complaint = planner::complaint_about(*answer.proof, scene_, question_);
      Case::require(!complaint, "proof: " + complaint.value_or(""));
      case_.count("proofs");
    }
    case_.count("cells", answer.cells);
  }

 private:
  using Node = std::array<int, 3>;  // x, y, angle
  struct PlanarPose {
    int x = 0, y = 0, angle = 0;  // of the grid
  };

  // ----- what is asked

  void tell(const char* what, const std::vector<Polygon>& polygons) const {
    std::string text = what;
    for (const Polygon& polygon : polygons) {
      text += " [";
      for (const auto& p : polygon) text += " (" + to_string(p[0]) + "," + to_string(p[1]) + ")";
      text += " ]";
    }
    case_.tell(text);
  }

  std::vector<Polygon> random_robot() {
    Choices& choices = case_.choices();
    const int length = choices.between(2, 8);
    const int width = choices.between(1, 4);
    const int x = choices.between(-4, 0);
    const int y = choices.between(-2, 0);
    std::vector<Polygon> robot{rectangle(quarters(x), quarters(y), quarters(x + length), quarters(y + width))};
    switch (choices.below(4)) {
      case 1:  // an L
        robot.push_back(rectangle(quarters(x), quarters(y), quarters(x + width), quarters(y + choices.between(2, 6))));
        break;
      case 2:  // a triangle
        robot[0].pop_back();
        break;
      case 3:  // a dumbbell
        robot.push_back(rectangle(quarters(x), quarters(y - 1), quarters(x + 2), quarters(y + width + 1)));
        robot.push_back(
            rectangle(quarters(x + length - 1), quarters(y - 1), quarters(x + length + 1), quarters(y + width + 1)));
        break;
      default:
        break;
    }
    return robot;
  }

  std::vector<Polygon> random_obstacles() {
    Choices& choices = case_.choices();
    std::vector<Polygon> obstacles;
    if (!choices.one_in(5)) {  // a wall with a gap, or a slot
      static const std::array<Rational, 6> kGaps{Rational(1),    Rational(1, 2),      Rational(3, 4),
                                                 Rational(3, 2), Rational(999, 1000), Rational(1001, 1000)};
      const int x = choices.between(10, 16);
      const int thick = choices.between(1, 8);
      const int y = choices.between(6, 20);
      const Rational gap = choices.element(kGaps);
      const int how = static_cast<int>(choices.below(3));
      const std::array<Rational, 2> about{quarters(x), quarters(y)};
      obstacles.push_back(turned(rectangle(quarters(x), -25, quarters(x + thick), quarters(y)), about, how));
      obstacles.push_back(turned(rectangle(quarters(x), quarters(y) + gap, quarters(x + thick), 30), about, how));
    }
    for (std::uint32_t i = choices.below(5); i > 0; --i) {
      const int x = choices.between(0, 28);
      const int y = choices.between(0, 28);
      Polygon box =
          rectangle(quarters(x), quarters(y), quarters(x + choices.between(1, 6)), quarters(y + choices.between(1, 6)));
      if (choices.one_in(3)) box.pop_back();
      obstacles.push_back(turned(std::move(box), {quarters(x), quarters(y)}, static_cast<int>(choices.below(3))));
    }
    return obstacles;
  }

  // The plane of the question in space: where x, y and z go.
  AffineMap random_frame() {
    static constexpr int kFrames[][9] = {{1, 0, 0, 0, 1, 0, 0, 0, 1},  {0, 0, 1, 1, 0, 0, 0, 1, 0},
                                         {0, 1, 0, 0, 0, 1, 1, 0, 0},  {2, -1, 2, 1, -2, -2, 2, 2, -1},
                                         {5, 0, 0, 0, 3, -4, 0, 4, 3}, {2, -2, 1, 2, 1, -2, 1, 2, 2}};
    frame_ = case_.choices().below(std::size(kFrames));
    AffineMap map = AffineMap::identity();
    const int scale = frame_ < 3 ? 1 : frame_ == 4 ? 5 : 3;
    for (std::size_t k = 0; k < 9; ++k) {
      map.linear[k / 3][k % 3] = Rational(kFrames[frame_][k], scale);
      map.linear[k / 3][k % 3].canonicalize();
      back_.linear[k % 3][k / 3] = map.linear[k / 3][k % 3];  // the inverse of a rotation is its transpose
    }
    return map;
  }

  Polyhedron prism(const Polygon& polygon, const Rational& low, const Rational& high, const AffineMap& frame) const {
    std::vector<Rational3> points;
    for (const auto& p : polygon) {
      for (const Rational& z : {low, high}) points.push_back(frame({p[0], p[1], z}));
    }
    return convex_hull(points);
  }

  void draw() {
    Choices& choices = case_.choices();
    robot_ = random_robot();
    obstacles_ = random_obstacles();
    tell("robot", robot_);
    tell("obstacles", obstacles_);
    const AffineMap frame = random_frame();
    const bool box = frame_ < 3;
    if (box && choices.one_in(4)) scene_.contact = ContactRule::kForbid;
    static constexpr std::array<std::array<int, 2>, 4> kRanges{{{0, 360}, {0, 180}, {-90, 90}, {-180, 180}}};
    range_ = choices.element(kRanges);
    const auto pose = [&](int low_x, int high_x) {
      return PlanarPose{choices.between(low_x, high_x), choices.between(0, kPositions - 1),
                        16 * choices.between(0, kAngles / 16 - 1)};
    };
    start_ = pose(0, kPositions / 3);
    goal_ = pose(kPositions * 2 / 3, kPositions - 1);
    // The reference point is bounded by the box, or the robot by walls that it just fits between.
    if (!box) {
      obstacles_.push_back(rectangle(-9, -9, -2, 17));
      obstacles_.push_back(rectangle(10, -9, 17, 17));
      obstacles_.push_back(rectangle(-9, -9, 17, -2));
      obstacles_.push_back(rectangle(-9, 10, 17, 17));
    }
    std::vector<Polyhedron> parts;
    for (const Polygon& polygon : robot_) parts.push_back(prism(polygon, 0, 1, frame));
    scene_.robot = unite_all(parts);
    for (const Polygon& polygon : obstacles_) scene_.obstacles.push_back(prism(polygon, -1, 2, frame));
    if (box) {
      const Rational3 low = frame({0, 0, 0});
      const Rational3 high = frame({kSide, kSide, 0});
      scene_.box = {low, high};
    } else {
      const Polygon floor = rectangle(-9, -9, 17, 17);
      scene_.obstacles.push_back(prism(floor, -1, 0, frame));
      scene_.obstacles.push_back(prism(floor, 1, 2, frame));
    }
    scene_.obstacle_names.resize(scene_.obstacles.size(), "obstacle");
    question_.axis = planner::TurningAxis(frame({0, 0, 1}));
    question_.low = question_.axis.turn_of_degrees(range_[0]);
    question_.high = question_.axis.turn_of_degrees(range_[1]);
    question_.start = pose_of(start_, frame);
    question_.goal = pose_of(goal_, frame);
    bounded_ = box;
    case_.tell("frame " + std::to_string(frame_) + ", range " + std::to_string(range_[0]) + " to " +
               std::to_string(range_[1]) + ", start " + text_of(start_) + ", goal " + text_of(goal_) +
               (scene_.contact == ContactRule::kForbid ? ", contact forbidden" : ""));
  }

  [[nodiscard]] static std::string text_of(const PlanarPose& pose) {
    return std::to_string(pose.x) + "/8 " + std::to_string(pose.y) + "/8 angle " + std::to_string(pose.angle);
  }

  [[nodiscard]] Pose pose_of(const PlanarPose& pose, const AffineMap& frame) const {
    Rational x(pose.x, kStepsOfUnit);
    Rational y(pose.y, kStepsOfUnit);
    x.canonicalize();
    y.canonicalize();
    Rational share(pose.angle, kAngles);
    share.canonicalize();
    return {frame({x, y, 0}), question_.axis.turn_of_degrees(range_[0] + share * (range_[1] - range_[0]))};
  }

  // ----- the oracle

  [[nodiscard]] double angle_step() const { return (range_[1] - range_[0]) * M_PI / 180 / kAngles; }
  [[nodiscard]] bool is_ring() const { return range_[1] - range_[0] == 360; }
  [[nodiscard]] int angle_count() const { return is_ring() ? kAngles : kAngles + 1; }
  [[nodiscard]] static Node node_of(const PlanarPose& pose) { return {pose.x, pose.y, pose.angle}; }
  [[nodiscard]] std::size_t index_of(const Node& node) const {
    const auto at = [&](std::size_t k) { return static_cast<std::size_t>(node[k]); };
    return (at(2) * kPositions + at(1)) * kPositions + at(0);
  }

  [[nodiscard]] double reach() const {
    double reach = 0;
    for (const Polygon& polygon : robot_) {
      for (const auto& p : polygon) reach = std::max(reach, std::hypot(nearest_double(p[0]), nearest_double(p[1])));
    }
    return reach;
  }
  // How far one step along one coordinate takes a point of the robot, and how far from the next pose it can be.
  [[nodiscard]] double widest_step() const { return std::max(1.0 / kStepsOfUnit, angle_step() * reach()) + 1e-9; }
  [[nodiscard]] double deepest() const { return std::sqrt(0.5) / kStepsOfUnit + angle_step() / 2 * reach() + 1e-9; }

  [[nodiscard]] double room_at(double x, double y, double angle, const std::vector<Shape>& robot,
                               const std::vector<Shape>& obstacles) const {
    double room = HUGE_VAL;
    for (const Shape& piece : robot) {
      Shape there = piece;
      const auto place = [&](Point2& p) {
        p = {x + std::cos(angle) * p[0] - std::sin(angle) * p[1], y + std::sin(angle) * p[0] + std::cos(angle) * p[1]};
      };
      place(there.middle);
      for (Point2& p : there.points) place(p);
      for (const Shape& obstacle : obstacles) room = std::min(room, apart(there, obstacle));
    }
    return room;
  }

  void fill_grid() {
    room_.resize(static_cast<std::size_t>(kPositions) * kPositions * static_cast<std::size_t>(angle_count()));
    for (int t = 0; t < angle_count(); ++t) {
      const double angle = range_[0] * M_PI / 180 + t * angle_step();
      std::vector<Shape> robot = robot_shapes_;
      for (Shape& piece : robot) {
        for (Point2& p : piece.points) {
          p = {std::cos(angle) * p[0] - std::sin(angle) * p[1], std::sin(angle) * p[0] + std::cos(angle) * p[1]};
        }
        piece = shape_of(std::move(piece.points));
      }
      for (int y = 0; y < kPositions; ++y) {
        for (int x = 0; x < kPositions; ++x) {
          room_[index_of({x, y, t})] = static_cast<float>(
              room_at(x / double{kStepsOfUnit}, y / double{kStepsOfUnit}, 0, robot, obstacle_shapes_));
        }
      }
    }
    case_.count("poses", room_.size());
  }

  void check_end(bool refused, const PlanarPose& pose, const std::string& name) const {
    constexpr double kRounding = 1e-9;
    const double room = room_at(pose.x / double{kStepsOfUnit}, pose.y / double{kStepsOfUnit},
                                range_[0] * M_PI / 180 + pose.angle * angle_step(), robot_shapes_, obstacle_shapes_);
    Case::require(!(refused && room > kRounding), name + ": refused, and it surely is free");
    Case::require(refused || room > -kRounding, name + ": taken, and it surely is not free");
  }

  // Is there a way over poses with at least so much room? By steps along one coordinate, or several at once.
  [[nodiscard]] bool reaches(const Node& start, const Node& goal, double room, bool diagonally) const {
    // What bounds the robot rather than the reference point is an obstacle; the grid ends where the box does.
    if (!bounded_ && diagonally && touches_border(room)) return true;
    std::vector<char> seen(room_.size(), 0);
    std::deque<Node> queue{start};
    if (room_[index_of(start)] < room) return diagonally;
    seen[index_of(start)] = 1;
    while (!queue.empty()) {
      const Node at = queue.front();
      queue.pop_front();
      if (at == goal) return true;
      for (int code = 0; code < 27; ++code) {
        const Node step{code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1};
        const int moves = std::abs(step[0]) + std::abs(step[1]) + std::abs(step[2]);
        if (moves == 0 || (moves > 1 && !diagonally)) continue;
        Node next{at[0] + step[0], at[1] + step[1], at[2] + step[2]};
        if (is_ring()) next[2] = (next[2] + kAngles) % kAngles;
        if (next[0] < 0 || next[0] >= kPositions || next[1] < 0 || next[1] >= kPositions || next[2] < 0 ||
            next[2] >= angle_count() || room_[index_of(next)] < room || seen[index_of(next)] != 0) {
          continue;
        }
        seen[index_of(next)] = 1;
        queue.push_back(next);
      }
    }
    return false;
  }

  // Between walls the reference point may leave the grid.
  [[nodiscard]] bool touches_border(double room) const {
    for (int t = 0; t < angle_count(); ++t) {
      for (int i = 0; i < kPositions; ++i) {
        for (const Node& node :
             {Node{i, 0, t}, Node{i, kPositions - 1, t}, Node{0, i, t}, Node{kPositions - 1, i, t}}) {
          if (room_[index_of(node)] >= room) return true;
        }
      }
    }
    return false;
  }

  void check_path(const TurningAnswer& answer) const {
    Case::require(!answer.path.empty() && answer.path.front().position == question_.start.position &&
                      answer.path.front().turn == question_.start.turn &&
                      answer.path.back().position == question_.goal.position,
                  "path: wrong ends");
    const Rational full_turns = (answer.path.back().turn - question_.goal.turn) / 4;
    Case::require(full_turns == 0 || (is_ring() && full_turns.get_den() == 1), "path: ends at another angle");
    std::uint64_t poses = 0;
    for (std::size_t i = 0; i + 1 < answer.path.size(); ++i) {
      const Pose& from = answer.path[i];
      const Pose& to = answer.path[i + 1];
      Case::require(from.position == to.position || from.turn == to.turn, "path: moves and turns at once");
      const Rational3 a = back_(from.position);
      const Rational3 b = back_(to.position);
      Case::require(a[2] == 0 && b[2] == 0, "path: leaves the plane");
      const double low = question_.axis.degrees_of(from.turn) * M_PI / 180;
      const double high = question_.axis.degrees_of(to.turn) * M_PI / 180;
      constexpr int kSamples = 32;
      for (int k = 0; k <= kSamples; ++k, ++poses) {
        const double t = k / double{kSamples};
        const auto between = [&](std::size_t c) {
          return nearest_double(a[c]) + t * (nearest_double(b[c]) - nearest_double(a[c]));
        };
        const double x = between(0);
        const double y = between(1);
        Case::require(room_at(x, y, low + t * (high - low), robot_shapes_, obstacle_shapes_) > -1e-9,
                      "path: motion " + std::to_string(i) + " meets an obstacle");
        const bool outside = bounded_ && (std::min(x, y) < -1e-9 || std::max(x, y) > kSide + 1e-9);
        Case::require(!outside, "path: motion " + std::to_string(i) + " leaves the box");
      }
    }
    case_.count("poses of paths", poses);
  }

  const Case& case_;
  std::vector<Polygon> robot_;
  std::vector<Polygon> obstacles_;
  std::size_t frame_ = 0;
  AffineMap back_ = AffineMap::identity();  // from space to the plane
  bool bounded_ = true;
  std::array<int, 2> range_{0, 360};
  PlanarPose start_;
  PlanarPose goal_;
  planner::Scene scene_;
  planner::TurningQuestion question_;
  std::vector<Shape> robot_shapes_;
  std::vector<Shape> obstacle_shapes_;
  std::vector<float> room_;
};

}  // namespace

void fuzz_turning(const Case& the_case) { TurningCase(the_case).run(); }

}  // namespace nef::fuzz

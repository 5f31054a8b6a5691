// SPDX-License-Identifier: Apache-2.0
//
// The moving parts are one robot among the others, seen from the middle of their box. Whoever is out of reach of the
// others may go anywhere there, so any pose beyond will do as the goal, and a box in which the robot gets past the
// others on all sides is as good as all of space.
//
// Screw axes are suggested by the faces of the moving parts between the others: the twist across which they slide most
// nearly, the least eigenvector of the sum of squares of their normal speeds [Gelfand, Guibas 2004]. Doubles choose it;
// each motion along it is certified. After each part of a turn a straight way out is looked for.
#include "apps/planner/assembly/turning_ways.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "apps/planner/intersection/vectors.h"
#include "apps/planner/rigid/certified_path.h"
#include "apps/planner/rigid_search/rigid_planning.h"
#include "apps/planner/turning/turning_search.h"
#include "nef/export/to_mesh.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"
#include "nef/number/simplest_between.h"

namespace nef::planner {
namespace {

// A rotation about a line, along which it goes on by so much for each radian.
struct ScrewAxis {
  Vector3d direction;  // of length 1
  Vector3d point;
  double pitch = 0;
};

Rational near(double x, double error) { return simplest_between(exact_rational(x - error), exact_rational(x + error)); }

Rational3 near(const Vector3d& v, double error) { return {near(v[0], error), near(v[1], error), near(v[2], error)}; }

class TurningWaySearch {
 public:
  TurningWaySearch(const Assembly& assembly, const PartSet& moving, const PartSet& stay, const TurningWayLimits& limits,
                   const Monitor& monitor)
      : assembly_(assembly), limits_(limits), monitor_(monitor) {
    for (const std::size_t part : moving) moving_.push_back(assembly.parts[part]);
    for (const std::size_t part : stay) stay_.push_back(assembly.parts[part]);
    body_ = unite_all(moving_, monitor_);
    mine_ = *bounding_box(body_, monitor_);
    theirs_ = *bounding_box(stay_.front(), monitor_);
    for (const Polyhedron& part : stay_) {
      const std::array<Rational3, 2> box = *bounding_box(part, monitor_);
      for (std::size_t k = 0; k < 3; ++k) {
        theirs_[0][k] = std::min(theirs_[0][k], box[0][k]);
        theirs_[1][k] = std::max(theirs_[1][k], box[1][k]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) middle_[k] = (mine_[0][k] + mine_[1][k]) / 2;
    // No point of the parts is farther from their middle.
    for (std::size_t k = 0; k < 3; ++k) reach_ += mine_[1][k] - middle_[k];
  }

  TurningWayAnswer run() {
    TurningWayAnswer answer;
    for (const ScrewAxis& axis : suggested()) {
      if (std::optional<TurningWay> way = along(axis)) {
        answer.status = TurningWayAnswer::Status::kWay;
        answer.way = std::move(way);
        return answer;
      }
    }
    return assembly_.turning_axis ? search_about_axis() : search_freely();
  }

 private:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  // The axes across which faces of the moving parts that are between the others slide. Steps that reach across the ends
  // of a thread, say, draw the least squares aside; weights that fall with the speed leave them out.
  std::vector<ScrewAxis> suggested() const {
    const Mesh mesh = to_mesh(body_, {}, monitor_).mesh;
    const Vector3d middle = to_vector(middle_);
    const double size = nearest_double(reach_);
    std::vector<Vector6> speeds;  // their products with a twist are speeds times areas
    std::vector<double> areas;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      std::array<Vector3d, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) corners[i] = (to_vector(mesh.vertices[face[i]]) - middle) / size;
      const Vector3d centre = (corners[0] + corners[1] + corners[2]) / 3;
      bool between = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = centre[static_cast<Eigen::Index>(k)] * size + middle[static_cast<Eigen::Index>(k)];
        between = between && x >= nearest_double(theirs_[0][k]) && x <= nearest_double(theirs_[1][k]);
      }
      const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);  // twice the area long
      if (!between || normal.norm() == 0) continue;
      Vector6& speed = speeds.emplace_back();
      speed << centre.cross(normal), normal;
      areas.push_back(normal.norm());
    }
    std::vector<ScrewAxis> result;
    for (Eigen::Index i = 0; i < 3; ++i) {
      Vector6 twist = least_twist(speeds, areas, nullptr, i);
      constexpr int kRounds = 20;
      for (int round = 0; round < kRounds; ++round) twist = least_twist(speeds, areas, &twist, 0);
      const Vector3d turn = twist.head<3>();
      const Vector3d move = twist.tail<3>() * size;
      if (turn.norm() < 1e-3) continue;
      ScrewAxis axis;
      axis.direction = turn.normalized();
      axis.point = middle + turn.cross(move) / turn.squaredNorm();
      axis.pitch = turn.dot(move) / turn.squaredNorm();
      ScrewAxis upright = axis;
      if (snap(upright, size)) result.push_back(upright);
      result.push_back(axis);
    }
    if (assembly_.turning_axis) {
      const Vector3d allowed = to_vector(*assembly_.turning_axis).normalized();
      std::erase_if(result, [&](const ScrewAxis& axis) { return axis.direction.cross(allowed).norm() > 1e-6; });
    }
    return result;
  }

  // The unit twist whose weighted squared speeds have the least sum, or the i-th after it; weights are by the speeds of
  // another twist, if there is one.
  static Vector6 least_twist(const std::vector<Vector6>& speeds, const std::vector<double>& areas,
                             const Vector6* before, Eigen::Index i) {
    constexpr double kSlow = 1e-3;
    Matrix6 sum = Matrix6::Zero();
    for (std::size_t f = 0; f < speeds.size(); ++f) {
      const double weight = before == nullptr ? 1 : 1 / (kSlow + std::abs(speeds[f].dot(*before)) / areas[f]);
      sum += weight / areas[f] * speeds[f] * speeds[f].transpose();
    }
    return Eigen::SelfAdjointEigenSolver<Matrix6>(sum).eigenvectors().col(i);
  }

  // Takes an axis that is nearly along a coordinate axis for one that is, through the middle of the others' box, the
  // origin, or the middle of the moving parts, if one of them is near. False if it is not.
  bool snap(ScrewAxis& axis, double size) const {
    constexpr double kNear = 0.05;
    Eigen::Index along = 0;
    if (axis.direction.cwiseAbs().maxCoeff(&along) < 1 - kNear * kNear) return false;
    axis.direction = (axis.direction[along] > 0 ? 1 : -1) * Vector3d::Unit(along);
    const Vector3d others = (to_vector(theirs_[0]) + to_vector(theirs_[1])) / 2;
    for (const Vector3d& point : {Vector3d(Vector3d::Zero()), others, to_vector(middle_)}) {
      Vector3d off = point - axis.point;
      off[along] = 0;
      if (off.norm() > kNear * size) continue;
      axis.point = point;
      break;
    }
    return true;
  }

  // A way along a screw axis, and from some part of a turn straight on.
  std::optional<TurningWay> along(const ScrewAxis& axis) {
    constexpr double kError = 1e-6;
    const double size = nearest_double(reach_);
    const Rational3 pivot = near(axis.point, kError * size);
    const Rational3 direction = assembly_.turning_axis ? *assembly_.turning_axis : near(axis.direction, kError);
    const double length = to_vector(direction).norm();
    // The way of a full turn, as a simple number, or more exactly.
    const double turn = 2 * M_PI * axis.pitch / length;
    std::set<Rational> pitches;
    for (const double error : {0.06, 0.003}) {
      pitches.insert(std::abs(turn) * length < 1e-2 * size ? Rational(0) : near(turn, error * std::abs(turn)));
    }
    for (const Rational& pitch : pitches) {
      if (std::optional<TurningWay> found = along(pivot, direction, pitch)) return found;
    }
    return std::nullopt;
  }

  std::optional<TurningWay> along(const Rational3& pivot, const Rational3& direction, const Rational& pitch) {
    constexpr int kMostSteps = 8 * 24;
    constexpr int kMostTurning = 12;  // without going on
    const double length = to_vector(direction).norm();
    const MotionChecker& checker = checker_about(pivot);
    TurningWay way;
    way.pivot = pivot;
    for (const int sign : {1, -1}) {
      way.poses = {RigidPose{}};
      for (int step = 1; step <= (pitch == 0 ? kMostTurning : kMostSteps); ++step) {
        monitor_.check_interruption();
        const RigidPose next = pose_at(Rational(sign * step) / (pitch == 0 ? 24 : 8), direction, length, pitch);
        const RigidMotion motion(way.poses.back(), next, MotionTiming::kSlerp);
        if (checker.check(motion, CheckLimits::for_planners(), monitor_).status != MotionVerdict::Status::kFree) break;
        way.poses.push_back(next);
        if (is_out(way) || goes_straight_out(way, direction)) return way;
      }
    }
    return std::nullopt;
  }

  // After some turns.
  static RigidPose pose_at(const Rational& turns, const Rational3& direction, double length, const Rational& pitch) {
    // The quaternion cos + sin n / |n|; beyond a half turn it changes its sign, which is the same rotation.
    const double half = M_PI * nearest_double(turns);
    const Rational w = near(std::cos(half), 1e-9);
    const Rational s = near(std::sin(half) / length, 1e-9);
    RigidPose pose;
    pose.quaternion = {w, s * direction[0], s * direction[1], s * direction[2]};
    for (std::size_t k = 0; k < 3; ++k) pose.position[k] = pitch * turns * direction[k];
    return pose;
  }

  [[nodiscard]] Polyhedron placed(const Rational3& pivot, const RigidPose& pose) const {
    return transform(transform(body_, AffineMap::translate(opposite(pivot)), monitor_),
                     map_of({plus(pose.position, pivot), pose.quaternion}), monitor_);
  }

  // The boxes around both are apart.
  [[nodiscard]] bool is_out(const TurningWay& way) const {
    const std::array<Rational3, 2> box = *bounding_box(placed(way.pivot, way.poses.back()), monitor_);
    for (std::size_t k = 0; k < 3; ++k) {
      if (box[0][k] >= theirs_[1][k] || box[1][k] <= theirs_[0][k]) return true;
    }
    return false;
  }

  // Adds the straight way along the axis or a coordinate axis after which they are, if it is free.
  bool goes_straight_out(TurningWay& way, const Rational3& direction) const {
    std::vector<Polyhedron> parts{placed(way.pivot, way.poses.back())};
    parts.insert(parts.end(), stay_.begin(), stay_.end());
    Blocking blocking(parts, monitor_);
    std::vector<Rational3> directions{direction, opposite(direction)};
    for (std::size_t k = 0; k < 3; ++k) {
      for (const int sign : {1, -1}) {
        Rational3 d;
        d[k] = sign;
        directions.push_back(d);
      }
    }
    for (const Rational3& d : directions) {
      bool free = true;
      for (std::size_t other = 1; free && other < parts.size(); ++other) free = !blocking.blocks(0, other, d);
      if (!free) continue;
      std::optional<Rational> least;
      for (std::size_t k = 0; k < 3; ++k) {
        if (d[k] == 0) continue;
        const Rational way_out = d[k] > 0 ? Rational(theirs_[1][k] - blocking.box(0)[0][k])
                                          : Rational(theirs_[0][k] - blocking.box(0)[1][k]);
        const Rational t = std::max(Rational(0), Rational(way_out / d[k]));
        if (!least || t < *least) least = t;
      }
      RigidPose end = way.poses.back();
      for (std::size_t k = 0; k < 3; ++k) end.position[k] += *least * d[k];
      way.poses.push_back(end);
      return true;
    }
    return false;
  }

  // Robot and obstacles with the pivot at the origin.
  [[nodiscard]] Scene scene_about(const Rational3& pivot) const {
    const AffineMap back = AffineMap::translate(opposite(pivot));
    Scene scene;
    scene.name = assembly_.name;
    scene.robot = transform(body_, back, monitor_);
    for (const Polyhedron& part : stay_) {
      scene.obstacles.push_back(transform(part, back, monitor_));
      scene.obstacle_names.emplace_back("part");
    }
    return scene;
  }

  const MotionChecker& checker_about(const Rational3& pivot) {
    if (!checker_ || pivot != pivot_) {
      checker_.emplace(MotionChecker::of_scene(scene_about(pivot), monitor_));
      pivot_ = pivot;
    }
    return *checker_;
  }

  // With the middle of the moving parts as the pivot, and a goal beyond the others.
  [[nodiscard]] Scene question() const {
    Scene scene = scene_about(middle_);
    Rational3 low;
    Rational3 high;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(theirs_[0][k], mine_[0][k]) - middle_[k] - 3 * reach_;
      high[k] = std::max(theirs_[1][k], mine_[1][k]) - middle_[k] + 3 * reach_;
    }
    scene.box = {low, high};
    scene.start = Rational3{};
    Rational3 goal;
    goal[2] = theirs_[1][2] - middle_[2] + 2 * reach_;
    scene.goal = goal;
    return scene;
  }

  TurningWayAnswer search_freely() {
    Scene scene = question();
    scene.turns_freely = true;
    scene.quaternions = {{{1, 0, 0, 0}, {1, 0, 0, 0}}};
    const MotionChecker checker = MotionChecker::of_scene(scene, monitor_);
    const RigidAnswer found = find_rigid_path(scene, checker, RigidLimits::of(limits_.max_cells, false), monitor_);
    monitor_.check_interruption();
    TurningWayAnswer answer;
    if (found.status == AnswerStatus::kPath) {
      answer.status = TurningWayAnswer::Status::kWay;
      answer.way = {middle_, found.path};
    } else if (found.status == AnswerStatus::kInfeasible) {
      answer.status = TurningWayAnswer::Status::kNone;
    }
    return answer;
  }

  TurningWayAnswer search_about_axis() {
    Scene scene = question();
    scene.rotation.emplace();
    scene.rotation->axis = *assembly_.turning_axis;
    const TurningQuestion asked = question_of(scene);
    const TurningAnswer found = find_turning_path(scene, asked, {.max_cells = limits_.max_cells}, monitor_);
    monitor_.check_interruption();
    TurningWayAnswer answer;
    if (found.status == AnswerStatus::kInfeasible) answer.status = TurningWayAnswer::Status::kNone;
    if (found.status != AnswerStatus::kPath) return answer;
    answer.status = TurningWayAnswer::Status::kWay;
    answer.way.emplace().pivot = middle_;
    std::vector<RigidPose>& poses = answer.way->poses;
    for (const Pose& pose : found.path) {
      // Turns of more than a quarter go the way of the path, not the shorter one.
      if (!poses.empty()) {
        Turn turn = last_turn_;
        while (abs(pose.turn - turn) > 1) {
          turn += pose.turn > turn ? 1 : -1;
          poses.push_back({poses.back().position, asked.axis.quaternion(turn)});
        }
      }
      poses.push_back({pose.position, asked.axis.quaternion(pose.turn)});
      last_turn_ = pose.turn;
    }
    return answer;
  }

  const Assembly& assembly_;
  TurningWayLimits limits_;
  const Monitor& monitor_;
  std::vector<Polyhedron> moving_;
  std::vector<Polyhedron> stay_;
  Polyhedron body_;
  std::array<Rational3, 2> mine_;
  std::array<Rational3, 2> theirs_;
  Rational3 middle_;
  Rational reach_ = 0;
  std::optional<MotionChecker> checker_;
  Rational3 pivot_;
  Turn last_turn_ = 0;
};

}  // namespace

TurningWayAnswer turning_way(const Assembly& assembly, const PartSet& moving, const PartSet& stay,
                             const TurningWayLimits& limits, const Monitor& monitor) {
  return TurningWaySearch(assembly, moving, stay, limits, monitor).run();
}

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// The motion is looked at in its poses and in the middle between them. At each of these times and for each pair of
// pieces that is near, the plane with the largest gap is chosen among the faces' planes and those along one edge of
// each. With these planes kept, the smallest gap is a concave, piecewise linear function of the positions, and a linear
// program maximizes it within a box around them. Then planes are chosen anew. Steps that do not help shrink the box.
#include "apps/planner/rigid_search/motion_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "apps/planner/rigid_search/linear_program.h"
#include "apps/planner/rigid_search/pose_metric.h"

namespace nef::planner {
namespace {

constexpr std::size_t kMostPairs = 4096;     // of pieces: all of them are looked at in each step
constexpr std::size_t kMostDirections = 24;  // of edges of a piece

void add_direction(const Vector3d& direction, bool opposite_too, std::vector<Vector3d>& directions) {
  for (const Vector3d& known : directions) {
    const double cosine = known.dot(direction);
    if ((opposite_too ? std::fabs(cosine) : cosine) > 1 - 1e-12) return;
  }
  directions.push_back(direction);
}

// The smallest and the largest product with a normal.
std::array<double, 2> range(const std::vector<Vector3d>& points, const Vector3d& normal) {
  std::array<double, 2> result{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Vector3d& p : points) {
    const double product = normal.dot(p);
    result[0] = std::min(result[0], product);
    result[1] = std::max(result[1], product);
  }
  return result;
}

}  // namespace

// A plane for a pair of pieces at a time.
struct MotionFit::Pair {
  std::size_t time = 0;
  Vector3d normal{0, 0, 0};  // away from the robot
  double gap = 0;
};

// The rotations at all times: those of the poses, and in the middle between two.
struct MotionFit::Turns {
  explicit Turns(std::span<const Quaternion> rotations) {
    std::optional<Eigen::Quaterniond> last;
    for (const Quaternion& q : rotations) {
      Eigen::Quaterniond next = PoseMetric::rounded(q);
      if (last && last->dot(next) < 0) next.coeffs() *= -1;
      if (last) times.push_back(Eigen::Quaterniond(last->coeffs() + next.coeffs()).normalized().toRotationMatrix());
      times.push_back(next.toRotationMatrix());
      last = next;
    }
  }
  // The position at a time.
  static Vector3d position(const std::vector<Vector3d>& positions, std::size_t time) {
    return (positions[time / 2] + positions[(time + 1) / 2]) / 2;
  }
  std::vector<Eigen::Matrix3d> times;
};

MotionFit::MotionFit(const MotionChecker& checker)
    : checker_(&checker), robot_(pieces_of(checker.robot())), obstacles_(pieces_of(checker.obstacles())) {
  worthwhile_ = robot_.size() * obstacles_.size() <= kMostPairs;
}

std::vector<MotionFit::Piece> MotionFit::pieces_of(const RigidBody& body) {
  std::vector<Piece> result;
  for (const RigidBody::Piece& piece : body.pieces()) {
    Piece& made = result.emplace_back();
    made.points = piece.points;
    for (const Vector3d& normal : piece.normals) {
      add_direction(normal, false, made.normals);
      if (piece.flat) add_direction(-normal, false, made.normals);
    }
    for (std::size_t f = 0; f < piece.mesh.face_count(); ++f) {
      const auto face = piece.mesh.face(f);
      for (std::size_t i = 0; i < face.size() && made.edges.size() < kMostDirections; ++i) {
        const Vector3d edge = made.points[face[(i + 1) % face.size()]] - made.points[face[i]];
        if (edge.norm() > 0) add_direction(edge.normalized(), true, made.edges);
      }
    }
    made.low = made.high = made.points.front();
    for (const Vector3d& p : made.points) {
      made.middle += p / static_cast<double>(made.points.size());
      made.low = made.low.cwiseMin(p);
      made.high = made.high.cwiseMax(p);
    }
    for (const Vector3d& p : made.points) made.radius = std::max(made.radius, (p - made.middle).norm());
  }
  return result;
}

MotionFit::Pair MotionFit::best_pair(const Eigen::Matrix3d& turn, const Vector3d& position, const Piece& robot,
                                     const Piece& obstacle, double enough) {
  std::vector<Vector3d> placed;
  placed.reserve(robot.points.size());
  for (const Vector3d& p : robot.points) placed.emplace_back(turn * p + position);
  Pair best;
  best.gap = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vector3d& normal, double gap) {
    if (gap <= best.gap) return;
    best.gap = gap;
    best.normal = normal;
  };
  for (const Vector3d& normal : obstacle.normals) {
    consider(-normal, range(placed, normal)[0] - range(obstacle.points, normal)[1]);
    if (best.gap >= enough) return best;
  }
  for (const Vector3d& a : robot.normals) {
    const Vector3d normal = turn * a;
    consider(normal, range(obstacle.points, normal)[0] - range(placed, normal)[1]);
    if (best.gap >= enough) return best;
  }
  for (const Vector3d& a : robot.edges) {
    const Vector3d turned = turn * a;
    for (const Vector3d& b : obstacle.edges) {
      Vector3d normal = turned.cross(b);
      const double length = normal.norm();
      constexpr double kParallel = 1e-6;
      if (length < kParallel) continue;
      normal /= length;
      const std::array<double, 2> ours = range(placed, normal);
      const std::array<double, 2> theirs = range(obstacle.points, normal);
      consider(normal, theirs[0] - ours[1]);
      consider(-normal, ours[0] - theirs[1]);
    }
  }
  return best;
}

void MotionFit::find_pairs(const Turns& turns, const std::vector<Vector3d>& positions, double reach,
                           std::vector<Pair>& pairs, const Monitor& monitor) const {
  pairs.clear();
  for (std::size_t time = 0; time < turns.times.size(); ++time) {
    const Vector3d position = Turns::position(positions, time);
    for (const Piece& robot : robot_) {
      const Vector3d middle = turns.times[time] * robot.middle + position;
      for (const Piece& obstacle : obstacles_) {
        const double away = std::max((obstacle.low - middle).maxCoeff(), (middle - obstacle.high).maxCoeff());
        if (away > robot.radius + reach) continue;
        monitor.check_interruption();
        Pair pair = best_pair(turns.times[time], position, robot, obstacle, reach);
        pair.time = time;
        if (pair.gap < reach) pairs.push_back(pair);
      }
    }
  }
}

// The positions after a linear program. Its variables are the moves of the positions, each from its smallest value on,
// and the smallest gap, from what it is there.
std::vector<Vector3d> MotionFit::step(const std::vector<Pair>& pairs, const std::vector<Vector3d>& positions,
                                      double trust, double margin) const {
  using Index = Eigen::Index;
  const auto moves = static_cast<Index>(3 * positions.size());
  const auto planes = static_cast<Index>(pairs.size());
  Eigen::VectorXd low = Eigen::VectorXd::Constant(moves, -trust);
  Eigen::VectorXd high = Eigen::VectorXd::Constant(moves, trust);
  for (Index i = 0; checker_->box() && i < moves; ++i) {
    const auto k = static_cast<std::size_t>(i % 3);
    const double at = positions[static_cast<std::size_t>(i / 3)][i % 3];
    low[i] = std::max(low[i], nearest_double((*checker_->box())[0][k]) - at);
    high[i] = std::min(high[i], nearest_double((*checker_->box())[1][k]) - at);
    low[i] = std::min(low[i], high[i]);
  }
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(planes + moves + 1, moves + 1);
  Eigen::VectorXd b(planes + moves + 1);
  for (Index i = 0; i < planes; ++i) {
    const Pair& pair = pairs[static_cast<std::size_t>(i)];
    for (Index k = 0; k < 3; ++k) {
      a(i, static_cast<Index>(3 * (pair.time / 2)) + k) += pair.normal[k] / 2;
      a(i, static_cast<Index>(3 * ((pair.time + 1) / 2)) + k) += pair.normal[k] / 2;
    }
    a(i, moves) = 1;
    b[i] = pair.gap;
  }
  a.block(planes, 0, moves, moves).setIdentity();
  b.segment(planes, moves) = high;
  a(planes + moves, moves) = 1;
  b[planes + moves] = margin;
  b -= a.leftCols(moves) * low;
  double least = b[planes + moves];
  for (Index i = 0; i < planes; ++i) least = std::min(least, b[i]);
  b.head(planes).array() -= least;
  b[planes + moves] -= least;
  Eigen::VectorXd c = Eigen::VectorXd::Zero(moves + 1);
  c[moves] = 1;
  const Eigen::VectorXd x = maximize(a, b, c);
  std::vector<Vector3d> moved = positions;
  for (Index i = 0; i < moves; ++i) moved[static_cast<std::size_t>(i / 3)][i % 3] += low[i] + x[i];
  return moved;
}

double MotionFit::fit(std::span<const Quaternion> rotations, std::vector<Vector3d>& positions, double reach,
                      double margin, const Monitor& monitor) const {
  const Turns turns(rotations);
  const auto smallest = [&](const std::vector<Pair>& pairs) {
    double gap = margin;
    for (const Pair& pair : pairs) gap = std::min(gap, pair.gap);
    return gap;
  };
  std::vector<Pair> pairs;
  const double near = 2 * reach + margin;
  find_pairs(turns, positions, near, pairs, monitor);
  double gap = smallest(pairs);
  double trust = reach;
  constexpr int kMostSteps = 8;
  for (int i = 0; i < kMostSteps && gap < margin && trust > reach / 32; ++i) {
    if (i > 2 && gap < -reach / 2) break;  // it does not look as if anything fitted
    monitor.check_interruption();
    std::vector<Vector3d> moved = step(pairs, positions, trust, margin);
    std::vector<Pair> next;
    find_pairs(turns, moved, near, next, monitor);
    const double found = smallest(next);
    if (found <= gap) {
      trust /= 3;
      continue;
    }
    positions = std::move(moved);
    pairs = std::move(next);
    if (found < gap + margin / 64) trust /= 2;
    gap = found;
  }
  return gap;
}

}  // namespace nef::planner

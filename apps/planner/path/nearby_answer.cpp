// SPDX-License-Identifier: Apache-2.0
//
// What the robot forbids itself by one piece of an obstacle, another piece cannot allow: all of free space is a part of
// what is free of some pieces. So a shortest way there that keeps away from all other pieces is a shortest way, too.
// Whether it does is told by projections of the swept robot's and of a piece's corners in doubles, which may err
// to "near", since another piece does no harm.
#include "apps/planner/path/partial_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/intersection/vectors.h"
#include "nef/base/error.h"
#include "nef/base/monitor.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/construct/construct.h"

namespace nef::planner {
namespace {

using RoughCorners = std::vector<Vector3d>;

// Where cutting into pieces is fast: surfaces have no walls to be cut along, small solids few.
constexpr std::size_t kSurfaceFacets = 200;
constexpr int kMostSteps = 60;
// Pieces come together with those around them: so far away at first, as a share of the robot's size, and by so much
// farther with each step.
constexpr double kAround = 0.25;
constexpr double kFarther = 1.15;

// The extent of some points along a direction.
struct Extent {
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
};

Extent extent_along(const Vector3d& direction, const RoughCorners& points) {
  Extent result;
  for (const Vector3d& p : points) {
    const double at = direction.dot(p);
    result.low = std::min(result.low, at);
    result.high = std::max(result.high, at);
  }
  return result;
}

double largest_coordinate(const RoughCorners& points) {
  double result = 0;
  for (const Vector3d& p : points) result = std::max(result, p.cwiseAbs().maxCoeff());
  return result;
}

// A convex part of an obstacle.
struct Piece {
  minkowski::ConvexCell cell;
  RoughCorners corners;
  Vector3d normal = Vector3d::Zero();  // of one that is flat
  std::vector<Extent> extents;         // along the fixed directions
  bool is_used = false;
};

// Directions across which a swept robot may be seen to be apart from a piece: towards faces, edges and corners of a
// cube.
std::vector<Vector3d> fixed_directions() {
  std::vector<Vector3d> result;
  for (int code = 14; code < 27; ++code) {  // one of each two opposite ones
    result.emplace_back(code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1);
  }
  return result;
}

// The robot that sweeps: corners of it, and the inside of the reflected one in convex parts.
struct SweptRobot {
  RoughCorners corners;
  std::vector<Extent> extents;  // along the fixed directions
  std::vector<minkowski::ConvexCell> inside;
};

SweptRobot swept_robot(const Polyhedron& robot, const std::vector<Vector3d>& directions, const Monitor& monitor) {
  SweptRobot result;
  const Complex& c = robot.complex();
  for (const VertexId v : c.vertex_ids()) result.corners.push_back(to_vector(c.points.approximate(point_of(v))));
  for (const Vector3d& direction : directions) result.extents.push_back(extent_along(direction, result.corners));
  result.inside = minkowski::decompose(interior(minkowski::negate(robot, monitor), monitor), monitor);
  return result;
}

// The largest extent of the robot along an axis.
double size_of(const SweptRobot& robot) {
  double size = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Extent extent = extent_along(Vector3d::Unit(axis), robot.corners);
    size = std::max(size, extent.high - extent.low);
  }
  return size;
}

Piece piece_of(minkowski::ConvexCell cell, const std::vector<Vector3d>& directions) {
  Piece piece;
  for (const Rational3& v : cell.mesh.vertices) piece.corners.push_back(to_vector(v));
  if (cell.dimension == 2) {
    const RoughCorners& p = piece.corners;
    const Vector3d normal = (p[1] - p[0]).cross(p[2] - p[0]);
    if (normal.norm() > 0) piece.normal = normal.normalized();
  }
  for (const Vector3d& direction : directions) piece.extents.push_back(extent_along(direction, piece.corners));
  piece.cell = std::move(cell);
  return piece;
}

std::vector<Piece> pieces_of(const std::vector<Polyhedron>& obstacles, const std::vector<Vector3d>& directions,
                             const Monitor& monitor) {
  std::vector<Piece> pieces;
  for (const Polyhedron& obstacle : obstacles) {
    for (minkowski::ConvexCell& cell : minkowski::decompose(closure(obstacle, monitor), monitor)) {
      pieces.push_back(piece_of(std::move(cell), directions));
    }
  }
  return pieces;
}

class NearSearch {
 public:
  NearSearch(const Scene& scene, const PathOptions& options, const Monitor& monitor)
      : scene_(scene),
        options_(options),
        monitor_(monitor),
        directions_(fixed_directions()),
        robot_(swept_robot(scene.robot, directions_, monitor)),
        around_(kAround * size_of(robot_)),
        pieces_(pieces_of(scene.obstacles, directions_, monitor)),
        scale_(largest_coordinate(robot_.corners) +
               largest_coordinate({to_vector(*scene.start), to_vector(*scene.goal)})) {
    for (const Piece& piece : pieces_) scale_ = std::max(scale_, largest_coordinate(piece.corners));
  }

  std::optional<Answer> run() {
    Stopwatch watch;
    Polyhedron positions =
        scene_.box ? make_box((*scene_.box)[0], (*scene_.box)[1], monitor_) : Polyhedron::everything();
    for (int step = 0; step < kMostSteps; ++step) {
      monitor_.check_interruption();
      Answer answer;
      const std::optional<std::vector<std::size_t>> near = near_ways(FreeSpace(positions), answer.path);
      if (!near) return std::nullopt;
      if (near->empty()) {
        answer.status = Answer::Status::kPath;
        answer.thinness = Thinness{3, 3};
        answer.phases["query"] = watch.lap();
        return answer;
      }
      positions = subtract(positions, forbidden_by(*near), monitor_);
    }
    return std::nullopt;
  }

 private:
  // The positions that some pieces forbid: those at which the inside of the robot meets one.
  [[nodiscard]] Polyhedron forbidden_by(const std::vector<std::size_t>& pieces) const {
    // Two by two: pieces of a surface nearly coincide too often for a union of all at once (measured).
    std::vector<Polyhedron> forbidden;
    for (const std::size_t i : pieces) {
      for (const minkowski::ConvexCell& part : robot_.inside) {
        forbidden.push_back(to_polyhedron(convex_sum(pieces_[i].cell, part, monitor_), monitor_));
      }
    }
    return unite_all(forbidden, monitor_);
  }

  // Pieces that the robot may touch on its way, and those around; none if it touches none. Nothing if there is no way.
  // First on a way that is found fast; if that is free of the others, on the one that is asked for and on one through
  // the inside of free space, which shows that T = J = 3.
  std::optional<std::vector<std::size_t>> near_ways(const FreeSpace& free, std::optional<ExactPath>& path) {
    PathOptions fast = options_;
    fast.thorough = false;
    fast.digits.reset();
    PathOptions inside = fast;
    inside.roomy = true;
    for (const PathOptions* options : std::array<const PathOptions*, 3>{&fast, &inside, &options_}) {
      path = find_path(free, *scene_.start, *scene_.goal, *options, monitor_);
      if (!path || path->thinness.piece < 3) return std::nullopt;
      if (options == &inside && path->thinness.junction < 3) return std::nullopt;
      std::vector<std::size_t> near = pieces_near(path->points);
      if (!near.empty()) return near;
    }
    return std::vector<std::size_t>{};
  }

  [[nodiscard]] std::vector<std::size_t> pieces_near(const std::vector<Rational3>& way) {
    RoughCorners points;
    for (const Rational3& p : way) points.push_back(to_vector(p));
    if (points.size() == 1) points.push_back(points.front());
    bool any = false;
    std::vector<std::size_t> around;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].is_used) continue;
      bool is_around = false;
      for (std::size_t k = 0; k + 1 < points.size() && !any; ++k) {
        any = !is_apart(pieces_[i], points[k], points[k + 1], 0);
      }
      for (std::size_t k = 0; k + 1 < points.size() && !is_around; ++k) {
        is_around = !is_apart(pieces_[i], points[k], points[k + 1], around_);
      }
      if (is_around) around.push_back(i);
    }
    if (!any) return {};
    around_ *= kFarther;
    for (const std::size_t i : around) pieces_[i].is_used = true;
    return around;
  }

  // True if the closed robot, on its way from a to b, surely keeps this distance from a piece (in each direction that
  // is tried). Directions have a largest component of at most 1. Corners are off by u of the largest coordinate, a
  // product of three terms by 3u + 3u for each of the robot's corner, the way-point and the piece's corner, and the
  // sums by 2u of twice as much: some 24u, 2^-48; 2^-40 leave room. What is tiny is off by 2^-1074.
  [[nodiscard]] bool is_apart(const Piece& piece, const Vector3d& a, const Vector3d& b, double distance) const {
    const auto apart = [&](const Vector3d& direction, const Extent& robot, const Extent& other) {
      const double from = direction.dot(a);
      const double to = direction.dot(b);
      const double needed = distance * direction.norm() + 0x1p-40 * scale_ + 1e-300;
      return std::min(from, to) + robot.low > other.high + needed ||
             std::max(from, to) + robot.high < other.low - needed;
    };
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      if (apart(directions_[i], robot_.extents[i], piece.extents[i])) return true;
    }
    if (piece.normal.isZero()) return false;
    return apart(piece.normal, extent_along(piece.normal, robot_.corners), extent_along(piece.normal, piece.corners));
  }

  const Scene& scene_;
  const PathOptions& options_;
  Monitor monitor_;
  std::vector<Vector3d> directions_;
  SweptRobot robot_;
  double around_;  // how far from a way pieces are taken with it
  std::vector<Piece> pieces_;
  double scale_;  // the largest coordinate
};

// Has the scene start and goal, is the robot a bounded solid, are obstacles bounded and may be touched, and is one of
// them at least a large mesh that bounds no solid? (For solids a wide answer costs less.)
bool is_of_surfaces(const Scene& scene) {
  if (!scene.only_translates() || scene.contact != ContactRule::kAllow || !scene.start || !scene.goal) return false;
  if (!scene.robot.is_bounded() || !scene.robot.is_regular()) return false;
  bool any = false;
  for (const Polyhedron& obstacle : scene.obstacles) {
    if (!obstacle.is_bounded()) return false;
    const bool is_mesh = obstacle.complex().facets.size() >= kSurfaceFacets;
    if (is_mesh && !interior(obstacle).is_empty()) return false;
    any = any || is_mesh;
  }
  return any;
}

}  // namespace

std::optional<Answer> nearby_answer(const Scene& scene, const PathOptions& options, const Monitor& monitor) {
  return is_of_surfaces(scene) ? NearSearch(scene, options, monitor.quiet()).run() : std::nullopt;
}

}  // namespace nef::planner

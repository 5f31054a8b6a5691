// SPDX-License-Identifier: Apache-2.0
//
// plane_between tries the normals of faces, which separate most pairs that are apart, and then follows the algorithm of
// Gilbert, Johnson and Keerthi: the point nearest to the origin in a simplex of differences gives a direction, and the
// farthest difference in the opposite one is the next corner. Only verified planes count, so the search may stop
// anywhere.
//
// overlap knows the generic ways in which convex polytopes meet: a vertex of one is inside the other, or an edge of one
// goes through a face of the other. Otherwise a point inside both is looked for by projections on the planes of faces.
// What remains is left to hulls_are_apart.
#include "apps/planner/rigid/separation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace nef::planner {
namespace {

// A product n p of a direction in doubles, which counts as exact, and a point is off by kImageError |n|_1 reach and
// three roundings, 2^-51 of the same: together and for two points less than twice kImageError.
constexpr double kPlaneError = 2 * MotionCell::kImageError;

// Beyond, sums of three products may overflow.
constexpr double kLargestReach = 1e300;

// Turned normals of length 1 are off by 256 roundings in each coordinate; differences to a point of the face are at
// most 2 reach long. That makes 3 kImageError 2 reach at most, and the points' own errors 2 sqrt(3) / 2 kImageError
// reach.
constexpr double kSideError = 8 * MotionCell::kImageError;

// Whatever stands in the way of a plane with normal n most, seen from each side.
struct Supports {
  Vector3d of_a;
  Vector3d of_b;
  double gap = 0;  // what lies between, in multiples of n
};

Supports supports(const RoughPolytope& a, const RoughPolytope& b, const Vector3d& n) {
  Supports result;
  double most = -HUGE_VAL;
  double least = HUGE_VAL;
  for (const Vector3d& p : a.points) {
    const double at = n.dot(p);
    if (at > most) {
      most = at;
      result.of_a = p;
    }
  }
  for (const Vector3d& p : b.points) {
    const double at = n.dot(p);
    if (at < least) {
      least = at;
      result.of_b = p;
    }
  }
  result.gap = least - most;
  return result;
}

// A simplex of differences b - a, one to four of them, and its point nearest to the origin. Only a heuristic: rounding
// may make the point a worse one.
class NearestInSimplex {
 public:
  explicit NearestInSimplex(const Vector3d& first) : corners_{first}, nearest_(first) {}

  [[nodiscard]] const Vector3d& nearest() const { return nearest_; }

  // Adds a corner, and drops those that the nearest point does not need. False if it came no nearer, or all four are
  // needed: the origin is inside.
  bool add(const Vector3d& corner) {
    corners_[count_++] = corner;
    const double before = nearest_.squaredNorm();
    double best = before;
    unsigned kept = 0;
    const unsigned all = (1U << count_) - 1;
    const unsigned newest = 1U << (count_ - 1);
    for (unsigned subset = newest; subset <= all; ++subset) {
      const std::optional<Vector3d> point = projection(subset);
      if (!point || !(point->squaredNorm() < best)) continue;
      best = point->squaredNorm();
      nearest_ = *point;
      kept = subset;
    }
    std::size_t left = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if ((kept >> i & 1U) != 0) corners_[left++] = corners_[i];
    }
    count_ = left;
    return best < before && count_ < corners_.size();
  }

 private:
  // The point nearest to the origin in the affine hull of some corners, if it lies between them.
  [[nodiscard]] std::optional<Vector3d> projection(unsigned subset) const {
    std::array<Vector3d, 4> p;
    int n = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if ((subset >> i & 1U) != 0) p[static_cast<std::size_t>(n++)] = corners_[i];
    }
    if (n == 1) return p[0];
    Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d products = Eigen::Matrix3d::Identity();
    for (int i = 0; i + 1 < n; ++i) edges.col(i) = p[static_cast<std::size_t>(i) + 1] - p[0];
    products.topLeftCorner(n - 1, n - 1) = (edges.transpose() * edges).topLeftCorner(n - 1, n - 1);
    const Vector3d weights = products.inverse() * -(edges.transpose() * p[0]);
    double first = 1;
    for (int i = 0; i + 1 < n; ++i) {
      if (!(weights[i] > 0)) return std::nullopt;
      first -= weights[i];
    }
    if (!(first > 0)) return std::nullopt;
    return Vector3d(p[0] + edges * weights);
  }

  std::array<Vector3d, 4> corners_;
  std::size_t count_ = 1;
  Vector3d nearest_;
};

// Signed distances of points to the plane of a face, as signs; 0 is not known.
int sign_beyond(double value, double bound) {
  if (value > bound) return 1;
  if (value < -bound) return -1;
  return 0;
}

// One of two pieces where it is, with what bounds its errors.
struct Placed {
  const Mesh& mesh;
  const std::vector<Vector3d>& points;
  const std::vector<Vector3d>& normals;
  bool flat;
};

// The segment from p to q meets the inside of a face.
bool pierces(const Vector3d& p, const Vector3d& q, const Placed& body, std::size_t face, double bound) {
  const auto ring = body.mesh.face(face);
  int turn = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector3d from = body.points[ring[i]] - p;
    const Vector3d to = body.points[ring[(i + 1) % ring.size()]] - p;
    const int sign = sign_beyond((q - p).dot(from.cross(to)), bound);
    if (sign == 0 || (turn != 0 && sign != turn)) return false;
    turn = sign;
  }
  return true;
}

// A vertex of a inside b, or an edge of a through a face of b; with errors of distances and of volumes.
bool enters(const Placed& a, const Placed& b, double distance_error, double volume_error) {
  const std::size_t n = a.points.size();
  std::vector<int> inside(n, b.flat || b.normals.empty() ? 0 : -1);
  std::vector<int> sides(n);
  for (std::size_t f = 0; f < b.normals.size(); ++f) {
    const Vector3d& corner = b.points[b.mesh.face(f)[0]];
    for (std::size_t i = 0; i < n; ++i) {
      sides[i] = sign_beyond(b.normals[f].dot(a.points[i] - corner), distance_error);
      if (sides[i] >= 0) inside[i] = 0;
    }
    for (std::size_t g = 0; g < a.mesh.face_count(); ++g) {
      const auto ring = a.mesh.face(g);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::uint32_t from = ring[i];
        const std::uint32_t to = ring[(i + 1) % ring.size()];
        if (sides[from] * sides[to] >= 0) continue;
        if (pierces(a.points[from], a.points[to], b, f, volume_error)) return true;
      }
    }
    // A stick has no faces.
    if (a.mesh.face_count() == 0 && n == 2 && sides[0] * sides[1] < 0 &&
        pierces(a.points[0], a.points[1], b, f, volume_error)) {
      return true;
    }
  }
  return std::any_of(inside.begin(), inside.end(), [](int sign) { return sign < 0; });
}

// A point moves to the other side of the plane that it is farthest beyond, again and again, until it is behind all by a
// margin m, 4 kImageError = 1024u of the reach R of both or more. Let n be a rounded normal, within 8u of the true one
// N in each coordinate (4u, and 4u more of a rotation of rounded entries). With the plane through the foremost rounded
// vertex q, N p - N q for a true vertex is at most n p - n q and 24u R for each of p and q, 3 kImageError R for q's
// error and 6u R for the roundings of the products, p being no farther out than R: below m.
bool have_inner_point(const Placed& a, const Placed& b, double reach, double margin) {
  struct Side {
    const Vector3d* normal;
    double offset;
  };
  std::vector<Side> sides;
  Vector3d low = Vector3d::Constant(-HUGE_VAL);
  Vector3d high = Vector3d::Constant(HUGE_VAL);
  for (const Placed* body : {&a, &b}) {
    Vector3d least = body->points.front();
    Vector3d most = least;
    for (const Vector3d& q : body->points) {
      least = least.cwiseMin(q);
      most = most.cwiseMax(q);
    }
    low = low.cwiseMax(least);
    high = high.cwiseMin(most);
    for (const Vector3d& n : body->normals) {
      double foremost = -HUGE_VAL;
      for (const Vector3d& q : body->points) foremost = std::max(foremost, n.dot(q));
      sides.push_back({&n, foremost - margin});
    }
  }
  Vector3d p = (low + high) / 2;  // of what both boxes have in common
  constexpr int kRounds = 40;
  for (int round = 0; round < kRounds; ++round) {
    if (!(p.lpNorm<Eigen::Infinity>() <= reach && reach < kLargestReach)) return false;
    const Side* worst = nullptr;
    double beyond = 0;
    for (const Side& side : sides) {
      const double there = side.normal->dot(p) - side.offset;
      if (worst == nullptr || there > beyond) {
        worst = &side;
        beyond = there;
      }
    }
    if (beyond < 0) return true;
    p -= (1.5 * beyond + 1e-6 * (high - low).norm()) * *worst->normal;
  }
  return false;
}

}  // namespace

void place(const RigidBody::Piece& piece, const MotionCell& cell, RoughPolytope& result) {
  result.clear();
  for (const Vector3d& p : piece.points) {
    cell.for_each_image(p, [&](const Vector3d& image) { result.points.push_back(image); });
  }
  for (const Vector3d& n : piece.normals) {
    result.normals.emplace_back(cell.turns[0] * n);
    if (piece.flat) result.normals.emplace_back(-result.normals.back());
  }
  result.reach = piece.reach + cell.position_reach;
  result.slack = cell.slack;
}

void place(const RigidBody::Piece& piece, RoughPolytope& result) {
  result.points = piece.points;
  result.normals = piece.normals;
  if (piece.flat) {
    for (const Vector3d& n : piece.normals) result.normals.emplace_back(-n);
  }
  result.reach = piece.reach;
  result.slack = 0;
}

void keep_face_normals(const RigidBody::Piece& piece, const MotionCell& cell, RoughPolytope& result) {
  result.normals.clear();
  for (const Vector3d& n : piece.normals) result.normals.emplace_back(cell.turns[0] * n);
}

Separation plane_between(const RoughPolytope& a, const RoughPolytope& b, Vector3d* normal) {
  const double reach = a.reach + b.reach;
  if (!(reach < kLargestReach)) return Separation::kPerhaps;
  // What the difference of two products n p, p one of either's points, is off by at most, for |n|_1 = 1.
  const double error_of_unit = kPlaneError * reach + MotionCell::kVanished;
  const double slack = a.slack + b.slack;
  bool perhaps = false;
  Supports last;
  const auto separates = [&](const Vector3d& n) {
    last = supports(a, b, n);
    const double error = (error_of_unit + slack) * n.lpNorm<1>() + MotionCell::kVanished;
    perhaps = perhaps || last.gap >= -error;
    if (last.gap > error && normal != nullptr) *normal = n;
    return last.gap > error;
  };
  for (const Vector3d& n : b.normals) {
    if (separates(-n)) return Separation::kApart;
  }
  for (const Vector3d& n : a.normals) {
    if (separates(n)) return Separation::kApart;
  }
  NearestInSimplex simplex(b.points.front() - a.points.front());
  constexpr int kRounds = 24;
  for (int round = 0; round < kRounds; ++round) {
    const double length = simplex.nearest().norm();
    if (!(length > kPlaneError * reach)) break;
    if (separates(simplex.nearest() / length)) return Separation::kApart;
    if (!simplex.add(last.of_b - last.of_a)) break;
  }
  return perhaps ? Separation::kPerhaps : Separation::kUnknown;
}

// Errors: a point is off by kImageError reach in each coordinate, and by the slack as a whole. A distance to a plane is
// off by sqrt(3) times that and by kSideError for the normal. A volume (q - p) x y of vectors no longer than L is off
// by 3 L^2 times the error of a difference, which is less than 4 kImageError reach + slack; its own roundings are far
// less. Below 1e100 no volume overflows; in one of vectors below 1 some 2^-1074 may vanish, in one of longer ones that
// is far below the roundings.
Separation overlap(const RigidBody::Piece& piece_a, const RoughPolytope& a, const RigidBody::Piece& piece_b,
                   double slack) {
  const double reach = a.reach + piece_b.reach;
  const double distance_error = kSideError * reach + slack + MotionCell::kVanished;
  const Placed placed_a{piece_a.mesh, a.points, a.normals, piece_a.flat};
  const Placed placed_b{piece_b.mesh, piece_b.points, piece_b.normals, piece_b.flat};
  // The boxes of pieces that are asked about overlap: no two vertices are farther apart than both diameters together.
  const double length = 2 * (piece_a.diameter + piece_b.diameter) + distance_error;
  if (!(length < 1e100 && reach < kLargestReach)) return Separation::kUnknown;
  const double volume_error =
      4 * length * length * (4 * MotionCell::kImageError * reach + slack) + MotionCell::kVanished;
  if (enters(placed_a, placed_b, distance_error, volume_error) ||
      enters(placed_b, placed_a, distance_error, volume_error)) {
    return Separation::kOverlapping;
  }
  const bool solid = !piece_a.flat && !piece_b.flat && !a.normals.empty() && !piece_b.normals.empty();
  if (solid && have_inner_point(placed_a, placed_b, reach, distance_error)) {
    return Separation::kOverlapping;
  }
  return Separation::kUnknown;
}

}  // namespace nef::planner

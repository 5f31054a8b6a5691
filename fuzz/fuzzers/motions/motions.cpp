// SPDX-License-Identifier: Apache-2.0
//
// Motions of solids and triangle soups on a grid, proved free or colliding, against exact poses on them.
//
// The oracle knows convex pieces by integer vertices. Quaternions are integers over a whole length, so a pose of the
// motion takes vertices to integers over one denominator, and separating directions are tried in 128 bits: normals of
// faces, products of two edges, and those of a flat piece's normal with its edges. Motions whose angle goes evenly with
// the position have irrational poses; there the oracle is long double, with a margin.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "apps/planner/rigid/motion_checker.h"
#include "fuzz/fuzzer.h"
#include "nef/construct/construct.h"
#include "nef/construct/convex_hull.h"
#include "nef/geometry/vectors.h"
#include "nef/number/int128.h"

namespace nef::fuzz {
namespace {

using planner::CheckLimits;
using planner::ContactRule;
using planner::MotionChecker;
using planner::MotionTiming;
using planner::MotionVerdict;
using planner::RigidBody;
using planner::RigidMotion;
using planner::RigidPose;

template <typename Z>
using Vector = std::array<Z, 3>;

constexpr int kUnit = 2;  // coordinates are halves

template <typename Z>
Z dot_of(const Vector<Z>& a, const Vector<Z>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <typename Z>
Vector<Z> minus_of(const Vector<Z>& a, const Vector<Z>& b) {
  return {Z(a[0] - b[0]), Z(a[1] - b[1]), Z(a[2] - b[2])};
}

template <typename Z>
Vector<Z> cross_product(const Vector<Z>& a, const Vector<Z>& b) {
  return {Z(a[1] * b[2] - a[2] * b[1]), Z(a[2] * b[0] - a[0] * b[2]), Z(a[0] * b[1] - a[1] * b[0])};
}

// A convex polytope or a triangle: vertices, three of each face, and edges.
struct GridPiece {
  std::vector<Vector<long>> vertices;
  std::vector<std::array<std::size_t, 3>> faces;
  std::vector<std::array<std::size_t, 2>> edges;
  bool flat = false;
};

// Every three vertices with all others on one side, and every two that are on two such planes.
GridPiece piece_of_points(std::vector<Vector<long>> points) {
  GridPiece piece;
  piece.vertices = std::move(points);
  const std::size_t n = piece.vertices.size();
  std::vector<Vector<long>> normals;
  std::vector<std::vector<bool>> on_face;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        const Vector<long> normal = cross_product(minus_of(piece.vertices[j], piece.vertices[i]),
                                                  minus_of(piece.vertices[k], piece.vertices[i]));
        if (normal == Vector<long>{}) continue;
        std::vector<bool> on(n);
        bool above = false;
        bool below = false;
        for (std::size_t v = 0; v < n; ++v) {
          const long at = dot_of(normal, minus_of(piece.vertices[v], piece.vertices[i]));
          above = above || at > 0;
          below = below || at < 0;
          on[v] = at == 0;
        }
        if ((above && below) || std::find(on_face.begin(), on_face.end(), on) != on_face.end()) continue;
        piece.flat = piece.flat || (!above && !below);
        piece.faces.push_back({i, j, k});
        on_face.push_back(std::move(on));
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const auto count = std::count_if(on_face.begin(), on_face.end(), [&](const auto& on) { return on[i] && on[j]; });
      if (count >= 2 || piece.flat) piece.edges.push_back({i, j});
    }
  }
  return piece;
}

// A piece where it is, with the directions that it brings.
template <typename Z>
struct PlacedGridPiece {
  std::vector<Vector<Z>> vertices;
  std::vector<Vector<Z>> normals;  // of faces, and in the plane of a flat piece
  std::vector<Vector<Z>> edges;
};

template <typename Z, typename Place>
PlacedGridPiece<Z> placed_piece(const GridPiece& piece, const Place& place) {
  PlacedGridPiece<Z> result;
  for (const Vector<long>& v : piece.vertices) result.vertices.push_back(place(v));
  const auto side = [&](std::size_t a, std::size_t b) { return minus_of(result.vertices[b], result.vertices[a]); };
  for (const auto& [a, b] : piece.edges) result.edges.push_back(side(a, b));
  for (const auto& [a, b, c] : piece.faces) result.normals.push_back(cross_product(side(a, b), side(a, c)));
  if (piece.flat) {
    for (const Vector<Z>& edge : result.edges) result.normals.push_back(cross_product(result.normals.front(), edge));
  }
  return result;
}

// How two pieces lie: apart, in contact without a common inner point, or overlapping.
enum class Meeting { kApart, kContact, kOverlap };

// Lengths below the margin, in units of the vertices, count as none: -1 asks for what surely is so apart.
template <typename Z>
Meeting meeting_of(const PlacedGridPiece<Z>& a, const PlacedGridPiece<Z>& b, double margin = 0) {
  Meeting meeting = Meeting::kOverlap;
  const auto look_along = [&](const Vector<Z>& n) {
    if (n == Vector<Z>{}) return;
    std::array<Z, 2> low{dot_of(n, a.vertices[0]), dot_of(n, b.vertices[0])};
    std::array<Z, 2> high = low;
    for (const Vector<Z>& v : a.vertices) {
      low[0] = std::min(low[0], dot_of(n, v));
      high[0] = std::max(high[0], dot_of(n, v));
    }
    for (const Vector<Z>& v : b.vertices) {
      low[1] = std::min(low[1], dot_of(n, v));
      high[1] = std::max(high[1], dot_of(n, v));
    }
    Z slack(0);
    if constexpr (std::is_floating_point_v<Z>) slack = static_cast<Z>(margin) * std::sqrt(dot_of(n, n));
    if (high[0] + slack < low[1] || high[1] + slack < low[0]) {
      meeting = Meeting::kApart;
    } else if (meeting == Meeting::kOverlap && (high[0] + slack <= low[1] || high[1] + slack <= low[0])) {
      meeting = Meeting::kContact;
    }
  };
  for (const Vector<Z>& n : a.normals) look_along(n);
  for (const Vector<Z>& n : b.normals) look_along(n);
  for (const Vector<Z>& e : a.edges) {
    for (const Vector<Z>& g : b.edges) look_along(cross_product(e, g));
  }
  return meeting;
}

struct GridBody {
  std::vector<GridPiece> pieces;
  bool soup = false;
};

// An integer quaternion whose length is a whole number.
struct GridQuaternion {
  std::array<long, 4> q;
  long length = 1;
};

struct GridPose {
  Vector<long> position{};
  GridQuaternion turn{};
};

// The rotation matrix of a quaternion, times its square.
template <typename Z>
std::array<Vector<Z>, 3> turn_of(const std::array<Z, 4>& q) {
  const auto& [w, x, y, z] = q;
  return {{{Z(w * w + x * x - y * y - z * z), Z(2 * (x * y - w * z)), Z(2 * (x * z + w * y))},
           {Z(2 * (x * y + w * z)), Z(w * w - x * x + y * y - z * z), Z(2 * (y * z - w * x))},
           {Z(2 * (x * z - w * y)), Z(2 * (y * z + w * x)), Z(w * w - x * x - y * y + z * z)}}};
}

class MotionCase {
 public:
  explicit MotionCase(const Case& the_case) : case_(the_case) {}

  void run() {
    Choices& choices = case_.choices();
    robot_ = random_body("robot", 4);
    obstacles_ = random_body("obstacles", 8);
    contact_ = choices.one_in(3) ? ContactRule::kForbid : ContactRule::kAllow;
    case_.tell(contact_ == ContactRule::kAllow ? "contact allowed" : "contact forbidden");
    const MotionChecker checker(body_of(robot_), body_of(obstacles_), contact_);
    for (std::uint32_t i = 1 + choices.below(40); i > 0; --i) check_motion(checker);
  }

 private:
  // With quaternions of lengths up to 10 and bodies within 16 units, coordinates stay below 2^30 then, and products of
  // four of them, the largest that occur, below 2^120.
  static constexpr long kSamples = 16;

  // ----- what is asked

  Vector<long> random_point(int low, int high) {
    Choices& choices = case_.choices();
    Vector<long> p;
    for (long& x : p) x = choices.between(low, high);
    return p;
  }

  GridBody random_body(const std::string& name, int spread) {
    Choices& choices = case_.choices();
    GridBody body;
    body.soup = choices.one_in(3);
    for (std::uint32_t k = 1 + choices.below(body.soup ? 5 : 3); k > 0; --k) {
      const Vector<long> at = random_point(-spread, spread);
      std::vector<Vector<long>> points;
      if (!body.soup && !choices.one_in(3)) {
        const Vector<long> size = random_point(1, 5);
        for (int corner = 0; corner < 8; ++corner) {
          points.push_back({at[0] + (corner & 1) * size[0], at[1] + (corner >> 1 & 1) * size[1],
                            at[2] + (corner >> 2 & 1) * size[2]});
        }
      } else {
        for (std::uint32_t n = body.soup ? 3 : 4 + choices.below(3); n > 0; --n) {
          const Vector<long> way = random_point(-3, 3);
          points.push_back({at[0] + way[0], at[1] + way[1], at[2] + way[2]});
        }
      }
      GridPiece piece = piece_of_points(std::move(points));
      if (piece.faces.empty() || piece.flat != body.soup) continue;
      std::string text = name + (body.soup ? " triangle" : " hull") + ", in halves:";
      for (const Vector<long>& v : piece.vertices) {
        text += " (" + std::to_string(v[0]) + "," + std::to_string(v[1]) + "," + std::to_string(v[2]) + ")";
      }
      case_.tell(text);
      body.pieces.push_back(std::move(piece));
    }
    if (body.pieces.empty()) {
      const std::vector<Vector<long>> points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
      body.soup = false;
      body.pieces.push_back(piece_of_points(points));
    }
    return body;
  }

  static Rational3 exact_point(const Vector<long>& v) {
    Rational3 p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = Rational(v[k], kUnit);
      p[k].canonicalize();
    }
    return p;
  }

  static RigidBody body_of(const GridBody& body) {
    if (body.soup) {
      Mesh mesh;
      for (const GridPiece& piece : body.pieces) {
        std::vector<std::uint32_t> ring;
        for (const Vector<long>& v : piece.vertices) {
          ring.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
          mesh.vertices.push_back(exact_point(v));
        }
        mesh.push_face(ring);
      }
      return RigidBody::of_surface(mesh);
    }
    std::vector<Polyhedron> solids;
    for (const GridPiece& piece : body.pieces) {
      std::vector<Rational3> points;
      for (const Vector<long>& v : piece.vertices) points.push_back(exact_point(v));
      solids.push_back(convex_hull(points));
    }
    return RigidBody::of_set(unite_all(solids));
  }

  GridPose random_pose() {
    static constexpr std::array<GridQuaternion, 11> kTurns{{{{1, 0, 0, 0}, 1},
                                                            {{1, 1, 1, 1}, 2},
                                                            {{0, 1, 2, 2}, 3},
                                                            {{3, 4, 0, 0}, 5},
                                                            {{1, 2, 2, 4}, 5},
                                                            {{1, 1, 3, 5}, 6},
                                                            {{2, 3, 6, 0}, 7},
                                                            {{1, 4, 4, 4}, 7},
                                                            {{2, 2, 3, 8}, 9},
                                                            {{2, 4, 5, 6}, 9},
                                                            {{1, 1, 7, 7}, 10}}};
    Choices& choices = case_.choices();
    GridPose pose;
    pose.position = random_point(-9, 9);
    pose.turn = choices.element(kTurns);
    for (std::size_t k = 3; k > 0; --k)
      std::swap(pose.turn.q[k], pose.turn.q[choices.below(static_cast<unsigned>(k) + 1)]);
    for (long& x : pose.turn.q) x = choices.one_in(2) ? -x : x;
    return pose;
  }

  static RigidPose exact_pose(const GridPose& pose) {
    RigidPose result{exact_point(pose.position), {}};
    for (std::size_t k = 0; k < 4; ++k) {
      result.quaternion[k] = Rational(pose.turn.q[k], pose.turn.length);
      result.quaternion[k].canonicalize();
    }
    return result;
  }

  static std::string text_of(const GridPose& pose) {
    std::string text = "(";
    for (const long x : pose.position) text += std::to_string(x) + " ";
    text += "| ";
    for (const long x : pose.turn.q) text += std::to_string(x) + " ";
    return text + "/ " + std::to_string(pose.turn.length) + ")";
  }

  // ----- the oracle

  // All pieces of both at a pose of the motion: the rotation at `turn` of `turns` parts of the arc, the position at
  // `time` of the same; all coordinates times one factor.
  template <typename Z>
  Meeting meeting_at(const GridPose& from, const GridPose& to, const Z& turn, const Z& time, const Z& whole,
                     double margin = 0) const {
    std::array<Z, 4> q;
    for (std::size_t k = 0; k < 4; ++k) {
      q[k] = Z(from.turn.q[k]) * Z(to.turn.length) * Z(whole - turn) + Z(to.turn.q[k]) * Z(from.turn.length) * turn;
    }
    const Z square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const auto matrix = turn_of<Z>(q);
    const auto moving = [&](const Vector<long>& v) {
      const Vector<Z> p{Z(v[0]), Z(v[1]), Z(v[2])};
      Vector<Z> image;
      for (std::size_t k = 0; k < 3; ++k) {
        image[k] =
            whole * dot_of(matrix[k], p) + square * (Z(whole - time) * Z(from.position[k]) + time * Z(to.position[k]));
      }
      return image;
    };
    const Z factor = whole * square;
    const auto still = [&](const Vector<long>& v) {
      return Vector<Z>{Z(factor * Z(v[0])), Z(factor * Z(v[1])), Z(factor * Z(v[2]))};
    };
    double scale = 0;
    if constexpr (std::is_floating_point_v<Z>) scale = static_cast<double>(factor);
    Meeting meeting = Meeting::kApart;
    for (const GridPiece& piece : robot_.pieces) {
      const PlacedGridPiece<Z> a = placed_piece<Z>(piece, moving);
      for (const GridPiece& obstacle : obstacles_.pieces) {
        meeting = std::max(meeting, meeting_of(a, placed_piece<Z>(obstacle, still), margin * scale));
      }
    }
    return meeting;
  }

  // A soup collides with all that it touches.
  [[nodiscard]] bool collides(Meeting meeting) const {
    const bool closed = contact_ == ContactRule::kForbid || robot_.soup || obstacles_.soup;
    return meeting == Meeting::kOverlap || (closed && meeting == Meeting::kContact);
  }

  static bool is_undecided(const MotionVerdict& verdict, double s) {
    return std::any_of(verdict.undecided.begin(), verdict.undecided.end(),
                       [&](const auto& part) { return part[0] <= s && s <= part[1]; });
  }

  // What a verdict says of a pose at which the oracle has found something.
  void check_sample(const MotionVerdict& verdict, const CheckLimits& limits, Meeting meeting, double s) const {
    using Status = MotionVerdict::Status;
    if (limits.in_order && s < verdict.free_until) {
      Case::require(!collides(meeting), "free: a pose before free_until collides, at " + std::to_string(s));
    }
    if (verdict.status == Status::kCollides || (limits.in_order && verdict.status == Status::kUndecided)) return;
    Case::require(!collides(meeting) || is_undecided(verdict, s), "free: a pose collides, at " + std::to_string(s));
    Case::require(verdict.status != Status::kFree || verdict.touches || meeting == Meeting::kApart,
                  "touches: there is contact, at " + std::to_string(s));
  }

  void check_motion(const MotionChecker& checker) {
    Choices& choices = case_.choices();
    const GridPose from = random_pose();
    GridPose to = random_pose();
    switch (choices.below(6)) {
      case 1:
        to.position = from.position;
        break;
      case 2:
        to.turn = from.turn;
        break;
      default:
        break;
    }
    CheckLimits limits;
    limits.max_cells = 300;
    limits.max_exact = 16;
    limits.in_order = choices.one_in(5);
    const MotionTiming timing = choices.one_in(4) ? MotionTiming::kSlerp : MotionTiming::kRational;
    case_.tell(text_of(from) + " to " + text_of(to) + (timing == MotionTiming::kSlerp ? ", even" : "") +
               (limits.in_order ? ", in order" : ""));
    const RigidMotion motion(exact_pose(from), exact_pose(to), timing);
    const MotionVerdict verdict = checker.check(motion, limits);
    // The arc that the motion takes.
    long product = 0;
    for (std::size_t k = 0; k < 4; ++k) product += from.turn.q[k] * to.turn.q[k];
    if (product < 0) {
      for (long& x : to.turn.q) x = -x;
    }
    if (!motion.turns()) to.turn = from.turn;
    const bool even = timing == MotionTiming::kSlerp && motion.turns();
    even ? check_even(verdict, limits, from, to, product) : check_exact(verdict, limits, motion, from, to);
    count(verdict, even);
  }

  // Of a motion that does not turn the pose is exact, the parameter rounded.
  static Rational collision_parameter(const MotionVerdict& verdict, const RigidMotion& motion) {
    if (motion.turns() || !motion.moves()) return exact_rational(verdict.parameter);
    const Rational3 way = minus(motion.to().position, motion.from().position);
    return dot(minus(verdict.pose->position, motion.from().position), way) / dot(way, way);
  }

  void check_exact(const MotionVerdict& verdict, const CheckLimits& limits, const RigidMotion& motion,
                   const GridPose& from, const GridPose& to) {
    bool contact = false;
    for (long k = 0; k <= kSamples; ++k) {
      const Meeting meeting = meeting_at<Int128>(from, to, k, k, kSamples);
      contact = contact || meeting != Meeting::kApart;
      check_sample(verdict, limits, meeting, static_cast<double>(k) / kSamples);
    }
    case_.count("exact poses", kSamples + 1);
    if (verdict.status == MotionVerdict::Status::kUndecided && !contact) case_.count("undecided without contact seen");
    if (verdict.status != MotionVerdict::Status::kCollides) return;
    const Rational s = collision_parameter(verdict, motion);
    const Meeting meeting = meeting_at<Integer>(from, to, s.get_num(), s.get_num(), s.get_den());
    Case::require(collides(meeting), "collides: the pose does not, at " + std::to_string(verdict.parameter));
  }

  // The time is the part of the angle that is done; all that is less clear than rounding is left out.
  void check_even(const MotionVerdict& verdict, const CheckLimits& limits, const GridPose& from, const GridPose& to,
                  long product) {
    constexpr double kMargin = 1e-7;
    const long double cosine =
        std::min(1.0L, std::abs(static_cast<long double>(product)) / (from.turn.length * to.turn.length));
    const long double angle = std::acos(cosine);
    const auto time_at = [&](long double s) { return std::atan2(s * std::sin(angle), 1 - s + s * cosine) / angle; };
    for (long k = 0; k <= kSamples; ++k) {
      const long double s = static_cast<long double>(k) / kSamples;
      Meeting meeting = meeting_at<long double>(from, to, s, time_at(s), 1, -kMargin);
      if (meeting == Meeting::kOverlap || collides(meeting)) {
        check_sample(verdict, limits, meeting, static_cast<double>(s));
      }
    }
    case_.count("rounded poses", kSamples + 1);
    if (verdict.status != MotionVerdict::Status::kCollides) return;
    const long double s = verdict.parameter;
    const Meeting meeting = meeting_at<long double>(from, to, s, time_at(s), 1, kMargin);
    Case::require(meeting != Meeting::kApart,
                  "collides: the pose does not, evenly, at " + std::to_string(verdict.parameter));
  }

  void count(const MotionVerdict& verdict, bool even) const {
    using Status = MotionVerdict::Status;
    const std::string how = even ? "even motions " : "motions ";
    case_.count(how + (verdict.status == Status::kFree       ? verdict.touches ? "free and touching" : "free"
                       : verdict.status == Status::kCollides ? "colliding"
                                                             : "undecided"));
  }

  const Case& case_;
  GridBody robot_;
  GridBody obstacles_;
  ContactRule contact_ = ContactRule::kAllow;
};

}  // namespace

void fuzz_motions(const Case& the_case) { MotionCase(the_case).run(); }

}  // namespace nef::fuzz

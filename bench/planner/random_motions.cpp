// SPDX-License-Identifier: Apache-2.0
//
// Verdicts on random motions of solids and of triangle soups, beside FCL at many poses of each and exact poses.
//
//   bench_planner_random_motions [motions, 100000] [seed, 1] [poses of a motion, 2000]
//
// A motion that is said to be free is sampled: where FCL reports a collision at a pose, Booleans of the exact sets at
// that pose decide, because FCL calculates in doubles and counts contact. Every tenth is also decided by Booleans at
// its start, since FCL does not notice a body inside another one. So is the part up to which a motion is free that is
// not free as a whole. Of a motion that is said to collide, the pose is
// asked of FCL, and of Booleans if FCL finds nothing there, or contact is likely, or by turns. In parts that are
// undecided the robot must turn and keep contact: FCL's distance at both ends and in the middle of the part is not more
// than kContact, or the motion counts as unexplained. Bodies: boxes, plates, L-shapes, random polytopes and unions of
// them, and soups of random triangles; obstacles: walls with windows, floors with columns, polytopes, soups, mixtures.
// A third of the motions has poses at small whole coordinates and rotations that permute the axes, so faces touch. Exit
// code 1 if a verdict is wrong or an undecided one unexplained.
#include <fcl/narrowphase/distance.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "apps/planner/rigid/motion_checker.h"
#include "bench/planner/fcl_bodies.h"
#include "nef/base/timing/stopwatch.h"
#include "nef/construct/construct.h"
#include "nef/polyhedron.h"

namespace nef::planner {
namespace {

constexpr double kContact = 1e-4;      // of bodies a few units large
constexpr unsigned kOfOneScene = 100;  // motions
constexpr unsigned kFewer = 10;        // times fewer poses of a motion that is free in part

// A body as a set for Booleans, and in pieces for the checker.
struct Body {
  std::vector<Polyhedron> solids;
  std::vector<Polyhedron> surfaces;
  std::vector<RigidBody> parts;
  std::string name;

  void add_solid(const Polyhedron& set) {
    solids.push_back(set);
    parts.push_back(RigidBody::of_set(set));
  }
  void add_surface(const Mesh& mesh) {
    std::vector<Polyhedron> faces;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      std::vector<Rational3> corners;
      for (const std::uint32_t v : mesh.face(f)) corners.push_back(mesh.vertices[v]);
      faces.push_back(convex_hull(corners));
    }
    surfaces.push_back(unite_all(faces));
    parts.push_back(RigidBody::of_surface(mesh));
  }
  [[nodiscard]] RigidBody whole() const { return RigidBody::together(parts); }
};

class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool one_of(int n) { return whole(1, n) == 1; }

  // Each coordinate a multiple of an eighth, no farther than `reach` from zero.
  Rational3 point(int reach) {
    Rational3 p;
    for (Rational& x : p) {
      x = Rational(whole(-8 * reach, 8 * reach), 8);
      x.canonicalize();
    }
    return p;
  }
  Polyhedron polytope(const Rational3& middle, int reach) {
    std::vector<Rational3> points;
    for (int count = whole(5, 10); count > 0; --count) points.push_back(sum(middle, point(reach)));
    for (std::size_t k = 0; k < 3; ++k) {  // so that it spans space
      points.push_back(middle);
      points.back()[k] += reach;
    }
    return convex_hull(points);
  }
  Mesh soup(int count, int reach, int size) {
    Mesh mesh;
    while (count > 0) {
      const Rational3 a = point(reach);
      const Rational3 b = sum(a, point(size));
      const Rational3 c = sum(a, point(size));
      if (is_on_a_line(a, b, c)) continue;
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
      mesh.push_face(std::vector<std::uint32_t>{first, first + 1, first + 2});
      --count;
    }
    return mesh;
  }
  Quaternion rotation() {
    std::normal_distribution<double> normal;
    return {exact_rational(normal(random_)), exact_rational(normal(random_)), exact_rational(normal(random_)),
            exact_rational(normal(random_))};
  }
  // One that permutes the axes, or turns about one.
  Quaternion special_rotation() {
    Quaternion q;
    do {
      for (Rational& x : q) x = whole(-1, 1);
    } while (q == Quaternion{0, 0, 0, 0});
    return q;
  }
  // Not far from another one.
  Quaternion rotation_near(const Quaternion& q, double spread) {
    Quaternion result = q;
    const double length = std::sqrt(nearest_double(scalar_product(q, q)));
    for (Rational& x : result) x += exact_rational(length * real(-spread, spread));
    return result;
  }

 private:
  static Rational3 sum(const Rational3& a, const Rational3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
  static bool is_on_a_line(const Rational3& a, const Rational3& b, const Rational3& c) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      if ((b[k] - a[k]) * (c[l] - a[l]) != (b[l] - a[l]) * (c[k] - a[k])) return false;
    }
    return true;
  }

  std::mt19937 random_;
};

Body random_robot(Chance& chance) {
  constexpr std::array kNames{"cube", "bar", "L", "polytope", "two polytopes", "soup", "cube and triangles"};
  Body body;
  const auto kind = static_cast<std::size_t>(chance.whole(0, 6));
  switch (kind) {
    case 0:
      body.add_solid(make_box({-1, -1, -1}, {1, 1, 1}));
      break;
    case 1:
      body.add_solid(make_box({-3, 0, 0}, {3, Rational(1, 4), Rational(1, 4)}));
      break;
    case 2:
      body.add_solid(unite(make_box({-2, -1, 0}, {2, 1, 1}), make_box({-2, -1, 0}, {-1, 1, 3})));
      break;
    case 3:
      body.add_solid(chance.polytope({0, 0, 0}, 1));
      break;
    case 4:
      body.add_solid(unite(chance.polytope({1, 0, 0}, 1), chance.polytope({-1, 0, 0}, 1)));
      break;
    case 5:
      body.add_surface(chance.soup(chance.whole(3, 8), 1, 1));
      break;
    default:
      body.add_solid(make_box({0, 0, 0}, {1, 1, 1}));
      body.add_surface(chance.soup(2, 1, 2));
  }
  body.name = kNames[kind];
  return body;
}

Body random_obstacles(Chance& chance) {
  constexpr std::array kNames{"wall", "floor", "soup", "polytopes", "sheet and triangles", "polytopes and triangles",
                              "boxes"};
  Body body;
  const auto kind = static_cast<std::size_t>(chance.whole(0, 6));
  body.name = kNames[kind];
  if (kind == 0) {
    body.add_solid(closure(subtract(make_box({4, -6, -6}, {5, 6, 6}), make_box({4, -1, -1}, {5, 1, 1}))));
  } else if (kind == 1) {
    body.add_solid(unite(make_box({-6, -6, -6}, {6, 6, -2}), make_box({3, 3, -2}, {4, 4, 6})));
  } else if (kind == 2) {
    body.add_surface(chance.soup(chance.whole(10, 30), 6, 2));
  } else if (kind == 3) {
    for (int count = chance.whole(2, 6); count > 0; --count) body.add_solid(chance.polytope(chance.point(5), 2));
  } else if (kind == 4) {  // a thin sheet with a hole, and its frame
    body.add_solid(
        closure(subtract(make_box({2, -6, -6}, {Rational(33, 16), 6, 6}), make_box({2, -2, -2}, {3, 2, 2}))));
    body.add_surface(chance.soup(6, 4, 3));
  } else if (kind == 5) {
    for (int count = chance.whole(1, 3); count > 0; --count) body.add_solid(chance.polytope(chance.point(5), 2));
    body.add_surface(chance.soup(8, 6, 3));
  } else {
    for (int count = chance.whole(4, 10); count > 0; --count) {
      const Rational3 at{chance.whole(-6, 6), chance.whole(-6, 6), chance.whole(-6, 6)};
      body.add_solid(make_box(at, {at[0] + 1, at[1] + chance.whole(1, 2), at[2] + chance.whole(1, 3)}));
    }
  }
  return body;
}

RigidMotion random_motion(Chance& chance, bool special) {
  RigidPose from;
  RigidPose to;
  for (RigidPose* pose : {&from, &to}) {
    for (Rational& x : pose->position) x = special ? Rational(chance.whole(-6, 6)) : exact_rational(chance.real(-7, 7));
    pose->quaternion = special ? chance.special_rotation() : chance.rotation();
  }
  if (chance.one_of(3)) to.quaternion = from.quaternion;
  if (chance.one_of(8)) to.position = from.position;
  if (!special && chance.one_of(2)) {  // as planners step
    to = from;
    for (Rational& x : to.position) x += exact_rational(chance.real(-1, 1));
    to.quaternion = chance.rotation_near(from.quaternion, 0.3);
  }
  return {from, to, chance.one_of(2) ? MotionTiming::kRational : MotionTiming::kSlerp};
}

fcl::Transform3d transform_of(const RigidPose& pose) {
  const auto near = [](const Rational& x) { return nearest_double(x); };
  fcl::Transform3d result = fcl::Transform3d::Identity();
  const Quaternion& q = pose.quaternion;
  result.linear() = Eigen::Quaterniond(near(q[0]), near(q[1]), near(q[2]), near(q[3])).normalized().toRotationMatrix();
  result.translation() = Vector3d(near(pose.position[0]), near(pose.position[1]), near(pose.position[2]));
  return result;
}

// One scene: the checker and what it is compared with.
class Comparison {
 public:
  Comparison(Body robot, Body obstacles, ContactRule contact)
      : robot_(std::move(robot)),
        obstacles_(std::move(obstacles)),
        contact_(contact),
        checker_(robot_.whole(), obstacles_.whole(), contact),
        robot_model_(fcl_model_of(checker_.robot())),
        obstacles_model_(fcl_model_of(checker_.obstacles())) {}

  [[nodiscard]] const MotionChecker& checker() const { return checker_; }
  [[nodiscard]] std::string name() const {
    return robot_.name + " among " + obstacles_.name + (contact_ == ContactRule::kForbid ? ", contact forbidden" : "");
  }
  [[nodiscard]] bool fcl_at(const fcl::Transform3d& pose) const {
    return fcl_collides(*robot_model_, pose, *obstacles_model_);
  }
  [[nodiscard]] double fcl_distance(const fcl::Transform3d& pose) const {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    return fcl::distance(robot_model_.get(), pose, obstacles_model_.get(), fcl::Transform3d::Identity(), request,
                         result);
  }
  // By the definition: interiors of solids overlap, or, with contact forbidden or a surface, there is a common point.
  [[nodiscard]] bool truly_collides(const RigidPose& pose) const {
    const AffineMap map = map_of(pose);
    const auto meet = [&](const std::vector<Polyhedron>& ours, const std::vector<Polyhedron>& theirs, bool closed) {
      for (const Polyhedron& a : ours) {
        const Polyhedron moved = transform(a, map);
        for (const Polyhedron& b : theirs) {
          if (!(closed ? intersect(moved, b) : intersect(interior(moved), interior(b))).is_empty()) return true;
        }
      }
      return false;
    };
    return meet(robot_.solids, obstacles_.solids, contact_ == ContactRule::kForbid) ||
           meet(robot_.solids, obstacles_.surfaces, true) || meet(robot_.surfaces, obstacles_.solids, true) ||
           meet(robot_.surfaces, obstacles_.surfaces, true);
  }

 private:
  Body robot_;
  Body obstacles_;
  ContactRule contact_;
  MotionChecker checker_;
  std::shared_ptr<FclModel> robot_model_;
  std::shared_ptr<FclModel> obstacles_model_;
};

// A motion in doubles, by the formula for constant speed (for kRational: linear, then of length 1).
class SampledMotion {
 public:
  explicit SampledMotion(const RigidMotion& motion) : motion_(motion) {
    for (std::size_t k = 0; k < 3; ++k) {
      from_[static_cast<Eigen::Index>(k)] = nearest_double(motion.from().position[k]);
      to_[static_cast<Eigen::Index>(k)] = nearest_double(motion.to().position[k]);
    }
    p_ = coefficients(motion.from().quaternion);
    q_ = coefficients(motion.to().quaternion);
    angle_ = angle(p_, q_);
  }
  [[nodiscard]] fcl::Transform3d at(double s) const {
    const Eigen::Vector4d q = (1 - s) * p_ + s * q_;
    const double time = motion_.timing() == MotionTiming::kRational || angle_ < 1e-6 ? s : angle(p_, q) / angle_;
    fcl::Transform3d result = fcl::Transform3d::Identity();
    result.linear() = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    result.translation() = (1 - time) * from_ + time * to_;
    return result;
  }

 private:
  static Eigen::Vector4d coefficients(const Quaternion& q) {
    return {nearest_double(q[0]), nearest_double(q[1]), nearest_double(q[2]), nearest_double(q[3])};
  }
  static double angle(const Eigen::Vector4d& p, const Eigen::Vector4d& q) {
    const Eigen::Vector4d a = p.normalized();
    const Eigen::Vector4d b = q.normalized();
    return 2 * std::atan2((a - b).norm(), (a + b).norm());
  }

  const RigidMotion& motion_;
  Vector3d from_, to_;
  Eigen::Vector4d p_, q_;
  double angle_ = 0;
};

struct Counts {
  std::array<std::size_t, 3> verdicts{};  // by MotionVerdict::Status
  std::size_t touching = 0;               // of those that are free
  std::size_t in_part = 0;                // of the others, those that are free up to somewhere
  std::size_t poses = 0;                  // asked of FCL
  std::size_t exact = 0;                  // decided by Booleans
  std::size_t fcl_hits = 0;               // of FCL on free motions
  std::size_t fcl_misses = 0;             // of FCL at colliding poses
  std::size_t false_free = 0;
  std::size_t false_collides = 0;
  std::size_t unexplained = 0;
  double seconds = 0;  // of the checker
};

std::string text_of(const RigidPose& pose) {
  std::string text;
  for (const Rational& x : pose.position) text += std::to_string(nearest_double(x)) + ' ';
  for (const Rational& x : pose.quaternion) text += std::to_string(nearest_double(x)) + ' ';
  return text;
}

// That no pose collides up to a parameter.
void check_free(const Comparison& scene, const RigidMotion& motion, double until, unsigned poses, Counts& counts) {
  const SampledMotion sampled(motion);
  bool is_wrong = false;
  const auto decide = [&](double s) {
    ++counts.exact;
    RigidPose pose = motion.at(s);
    if (!scene.truly_collides(pose)) return;
    std::cout << "false free: " << scene.name() << ", parameter " << s << " of " << until << " of "
              << text_of(motion.from()) << "to " << text_of(motion.to()) << '\n';
    is_wrong = true;
  };
  if (counts.verdicts[0] % 10 == 0) decide(0);
  unsigned doubted = 0;
  for (unsigned k = 0; k <= poses; ++k) {
    const double s = until * k / poses;
    ++counts.poses;
    if (!scene.fcl_at(sampled.at(s))) continue;
    ++counts.fcl_hits;
    // Contact that is kept gives many of them.
    if (doubted < 3 || k == poses) decide(s);
    ++doubted;
  }
  if (is_wrong) ++counts.false_free;
}

bool is_on(const RigidPose& pose, const RigidMotion& motion, double parameter) {
  const Quaternion q = motion.quaternion(exact_rational(parameter));
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      if (q[i] * pose.quaternion[j] != q[j] * pose.quaternion[i]) return false;
    }
  }
  const fcl::Transform3d near = SampledMotion(motion).at(parameter);
  return (near.translation() - transform_of(pose).translation()).norm() < 1e-7;
}

void check_colliding(const Comparison& scene, const RigidMotion& motion, const MotionVerdict& verdict, bool special,
                     Counts& counts) {
  ++counts.poses;
  const bool seen = scene.fcl_at(transform_of(*verdict.pose));
  if (!seen) ++counts.fcl_misses;
  bool right = is_on(*verdict.pose, motion, verdict.parameter);
  if (right && (!seen || special || counts.verdicts[1] % 20 == 0)) {
    ++counts.exact;
    right = scene.truly_collides(*verdict.pose);
  }
  if (right) return;
  ++counts.false_collides;
  std::cout << "false collides: " << scene.name() << ", parameter " << verdict.parameter << ", pieces "
            << verdict.robot_piece << ' ' << verdict.obstacle_piece << ", FCL " << seen << ": "
            << text_of(*verdict.pose) << "of " << text_of(motion.from()) << "to " << text_of(motion.to()) << '\n';
}

void check_undecided(const Comparison& scene, const RigidMotion& motion, const MotionVerdict& verdict, Counts& counts) {
  const SampledMotion sampled(motion);
  bool explained = motion.turns();
  double worst = 0;
  for (const auto& [low, high] : verdict.undecided) {
    double least = HUGE_VAL;
    for (const double s : {low, (low + high) / 2, high}) least = std::min(least, scene.fcl_distance(sampled.at(s)));
    worst = std::max(worst, least);
  }
  explained = explained && worst <= kContact;
  if (explained) return;
  ++counts.unexplained;
  std::cout << "undecided: " << scene.name() << ", at distance " << worst << ": " << text_of(motion.from()) << "to "
            << text_of(motion.to()) << '\n';
}

// What a planner takes for the last valid state of a motion that is not free.
void check_free_until(const Comparison& scene, const RigidMotion& motion, const MotionVerdict& verdict, unsigned poses,
                      Counts& counts) {
  CheckLimits limits;
  limits.in_order = true;
  const MotionVerdict ordered = scene.checker().check(motion, limits);
  const bool is_late = verdict.status == MotionVerdict::Status::kCollides && ordered.free_until > verdict.parameter;
  if (is_late || ordered.status == MotionVerdict::Status::kFree) {
    ++counts.false_free;
    std::cout << "free for too long: " << scene.name() << ", " << text_of(motion.from()) << "to "
              << text_of(motion.to()) << '\n';
    return;
  }
  if (ordered.free_until <= 0) return;
  ++counts.in_part;
  check_free(scene, motion, ordered.free_until, poses, counts);
}

int run(unsigned motions, unsigned seed, unsigned poses) {
  Chance chance(seed);
  Counts counts;
  for (unsigned done = 0; done < motions;) {
    const ContactRule contact = chance.one_of(3) ? ContactRule::kForbid : ContactRule::kAllow;
    Body robot = random_robot(chance);
    const Comparison scene(std::move(robot), random_obstacles(chance), contact);
    for (unsigned k = 0; k < kOfOneScene && done < motions; ++k, ++done) {
      const bool special = chance.one_of(3);
      const RigidMotion motion = random_motion(chance, special);
      const ProcessStopwatch watch;
      const MotionVerdict verdict = scene.checker().check(motion);
      counts.seconds += watch.seconds();
      ++counts.verdicts[static_cast<std::size_t>(verdict.status)];
      if (verdict.status == MotionVerdict::Status::kFree) {
        if (verdict.touches) ++counts.touching;
        check_free(scene, motion, 1, poses, counts);
        continue;
      }
      check_free_until(scene, motion, verdict, poses / kFewer, counts);
      if (verdict.status == MotionVerdict::Status::kCollides) {
        check_colliding(scene, motion, verdict, special, counts);
      } else {
        check_undecided(scene, motion, verdict, counts);
      }
    }
    if (done % 5000 < kOfOneScene) std::cerr << done << " motions\n";
  }
  std::cout << motions << " motions, " << 1e6 * counts.seconds / motions << " us each: " << counts.verdicts[0]
            << " free (" << counts.touching << " of them touch; " << counts.in_part << " others are in part), "
            << counts.verdicts[1] << " collide, " << counts.verdicts[2] << " undecided\n"
            << counts.poses << " poses asked of FCL, " << counts.exact << " decided by Booleans\n"
            << "FCL reports " << counts.fcl_hits << " collisions on free motions, and none at " << counts.fcl_misses
            << " colliding poses\n"
            << "wrong: " << counts.false_free << " free, " << counts.false_collides
            << " collides; unexplained: " << counts.unexplained << " undecided\n";
  return counts.false_free + counts.false_collides + counts.unexplained == 0 ? 0 : 1;
}

}  // namespace
}  // namespace nef::planner

int main(int argc, char** argv) {
  const auto argument = [&](int i, unsigned otherwise) {
    return argc > i ? static_cast<unsigned>(std::atoi(argv[i])) : otherwise;
  };
  return nef::planner::run(argument(1, 100000), argument(2, 1), std::max(1U, argument(3, 2000)));
}

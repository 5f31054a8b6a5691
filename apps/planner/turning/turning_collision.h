// SPDX-License-Identifier: Apache-2.0
//
// One pose or motion of a robot that turns, checked without any free space.
#pragma once

#include <vector>

#include "apps/planner/free_space/vectors.h"
#include "apps/planner/rigid/separation.h"
#include "apps/planner/turning/turning_question.h"
#include "apps/planner/turning/turning_robot.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Is a pose free, is a motion? Convex pieces of the robot against convex pieces of the obstacles: a plane that doubles
/// find, with room for their errors, answers nearly always, the exact hull of the differences of vertices else. Const
/// and safe to share between threads.
class TurningCollision {
 public:
  /// Throws InputError unless the robot is a bounded solid and the obstacles are bounded or the scene has a box.
  TurningCollision(const Scene& scene, const TurningAxis& axis, const Monitor& monitor = {});

  [[nodiscard]] const TurningAxis& axis() const { return robot_.axis(); }
  /// Exact.
  [[nodiscard]] bool is_free(const Pose& pose) const;
  /// From pose to pose, straight, while the angle goes up or down. Exact if the angle stays. Else true only if all is
  /// surely free, however the angle goes in between: the motion is cut up to `depth` times, and robots over ranges of
  /// angles are swept along what is left. The angles must be less than a half turn apart.
  [[nodiscard]] bool is_free(const Pose& from, const Pose& to, int depth = 12) const;

 private:
  struct Solid {
    std::vector<Rational3> vertices;  // of obstacles
    RoughPolytope rough;              // with the normals of all faces
    Vector3d low = Vector3d::Zero();  // of its points
    Vector3d high = Vector3d::Zero();
    bool flat = false;
  };
  // A piece of the robot in doubles.
  struct Shape {
    std::vector<Vector3d> points;
    std::vector<Vector3d> normals;
    double reach = 0;
  };
  // A motion in doubles.
  struct Swept {
    struct End {
      Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
      Vector3d position = Vector3d::Zero();
    };
    End from, to;
    double tangent = 0;
    double position_reach = 0;  // no coordinate of a position is larger
    bool turns = false;
    bool moves = false;
  };
  static void measure(Solid& solid);
  // What doubles find: see Separation.
  static Separation separation(const Solid& a, const Solid& b);
  // True if doubles find a point that is inside both with room to spare; the normals must be those of all faces.
  static bool surely_overlap(const Solid& a, const Solid& b);
  [[nodiscard]] bool surely_hits(std::size_t piece, const Swept& way, const Solid& obstacle) const;
  [[nodiscard]] bool exactly_apart(const std::vector<Rational3>& a, const std::vector<Rational3>& b) const;
  // A piece over a range of angles (or at one) along a translation: the corners that outer() takes, at both ends.
  [[nodiscard]] std::vector<Rational3> exactly_swept(const TurningRobot::Piece& piece, const Pose& from,
                                                     const Pose& to) const;
  // The same in doubles.
  [[nodiscard]] Swept sweep(const Pose& from, const Pose& to) const;
  [[nodiscard]] Solid swept(std::size_t piece, const Swept& sweep) const;
  [[nodiscard]] bool is_free_at(const Turn& turn, const Rational3& from, const Rational3& to) const;
  // By sets: does the inside of the robot, swept, meet what is flat?
  [[nodiscard]] bool meets_flat(const Solid& flat, const Turn& turn, const Rational3& from, const Rational3& to) const;

  TurningRobot robot_;
  std::vector<Shape> shapes_;  // of its pieces
  std::vector<Solid> obstacles_;
  std::optional<std::array<Rational3, 2>> box_;
  ContactRule contact_;
};

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// Robots from URDF files, as linkages.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/planner/linkage/linkage.h"
#include "apps/planner/scene/scene.h"
#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef::planner {

/// A link of a URDF file, and the joint that it hangs on.
struct UrdfLink {
  std::string name;
  /// What its collision geometry encloses, in the link's own coordinates; nothing if it has none.
  std::optional<Polyhedron> shape;
  LinkageJoint joint;      ///< of the root link without meaning
  std::string joint_name;  ///< empty for the root link
  /// Limits of the joint's value: the file's, or -pi and pi if the joint is continuous. Of a fixed joint 0.
  double lower = 0;
  double upper = 0;
  bool continuous = false;  ///< the joint turns without end: its limits do not bound it
};

/// What a URDF file says of a robot's motions.
struct UrdfRobot {
  std::string name;
  std::vector<UrdfLink> links;  ///< the root first, parents before their children, children in the file's order
  std::vector<std::array<std::size_t, 2>> allowed;  ///< pairs of links that are not compared, of an SRDF file
  Messages messages;                                ///< what was done to the meshes

  /// The names of the joints that have a value, in the order of the values.
  [[nodiscard]] std::vector<std::string> joint_names() const;
  /// What is wrong with values of these joints: the first one beyond the limits of a joint that is not continuous, as a
  /// text; nothing if all are within. There must be a value for each joint.
  [[nodiscard]] std::optional<std::string> complaint_about(std::span<const double> values) const;

  /// The links with the pieces of their shapes.
  [[nodiscard]] Linkage linkage(const Monitor& monitor = {}) const;
};

/// True if this build reads URDF files (it was built with urdfdom).
bool reads_urdf();

/// Reads a URDF file, through urdfdom. Joints are fixed, revolute, continuous or prismatic, and none mimics another
/// one; collision geometry is boxes and meshes. Rotations are those of the quaternions that urdfdom makes of roll,
/// pitch and yaw, exactly. A mesh `package://NAME/PATH` is looked for beside the URDF file and in all folders above it:
/// PATH in a folder called NAME. `meshes`: how mesh files are read (read_shape_file).
///
/// `srdf`, if not empty, is the SRDF file whose disable_collisions name pairs of links.
///
/// Throws InputError for anything else, and if this build has no urdfdom: the message says what to install.
UrdfRobot read_urdf(const std::string& file, const std::string& srdf = {}, const MeshOptions& meshes = scene_meshes());

}  // namespace nef::planner

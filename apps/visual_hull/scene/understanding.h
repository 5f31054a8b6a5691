// SPDX-License-Identifier: Apache-2.0
//
// What has been understood of a scene, so that people see at once whether it is what they meant.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "apps/visual_hull/scene/scene.h"

namespace nef::visual_hull {

/// Where a camera stands and looks, in doubles.
struct Sight {
  Eigen::Vector3d centre;
  Eigen::Vector3d axis;             ///< of length 1
  double focal_x = 0, focal_y = 0;  ///< in units of the image: pixels
  bool parallel = false;  ///< lines of sight are parallel: the centre is a point that is seen at (0, 0), and in place
                          ///< of focal lengths there are pixels a unit of length
};
Sight sight_of(const Camera& camera);

/// The point with the least sum of squared distances to the optical axes of all pinhole cameras; nothing if these are
/// (nearly) parallel.
std::optional<Eigen::Vector3d> common_point(const std::vector<Sight>& sights);

/// One line: how many views, from what format, which pixel has whole coordinates, focal lengths, where the cameras look
/// and from how far. Says so if cameras look away from that point, or if images are mirrored.
std::string understood(const Scene& scene);

/// A line a view: name, image (or polygons), focal length, centre, and the angle between the direction in which it
/// looks and the one to the common point.
std::vector<std::string> view_lines(const Scene& scene, const std::vector<std::filesystem::path>& images);

}  // namespace nef::visual_hull

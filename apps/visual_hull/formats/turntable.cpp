// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/formats/turntable.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "apps/visual_hull/scene/pose.h"
#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

Lens lens_of(const std::vector<double>& k) {
  Lens lens;
  if (k.size() == 3) {
    lens = {k[0], k[0], k[1], k[2], {}, {}};
  } else if (k.size() == 4) {
    lens = {k[0], k[1], k[2], k[3], {}, {}};
  } else if (k.size() == 9 && k[1] == 0 && k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1) {
    lens = {k[0], k[4], k[2], k[5], {}, {}};
  } else {
    throw nef::InputError("--K: f,cx,cy or fx,fy,cx,cy or fx,0,cx,0,fy,cy,0,0,1 is needed");
  }
  if (!(lens.fx > 0 && lens.fy > 0)) throw nef::InputError("--K: focal lengths are positive");
  return lens;
}

// Of a turn; the least int has no absolute value.
int images_of(int count) { return std::abs(std::max(count, -std::numeric_limits<int>::max())); }

}  // namespace

Scene make_turntable(const Turntable& turntable) {
  const int count = images_of(turntable.count);
  if (count < 2 || count > 100000)
    throw nef::InputError("--turntable N: from 2 to 100000 images, negative for clockwise");
  if (!(turntable.radius > 0)) throw nef::InputError("--radius: the distance of the camera from the axis is positive");
  const Lens lens = lens_of(turntable.intrinsics);
  Scene scene;
  scene.format = fmt::format("a turntable of {} degrees a step, {}", 360.0 / count,
                             turntable.count > 0 ? "counterclockwise" : "clockwise");
  for (int i = 0; i < count; ++i) {
    // Seen from the object, the camera goes round the other way.
    const double angle = (turntable.count > 0 ? -2 : 2) * M_PI * i / count;
    const Eigen::Vector3d centre(turntable.radius * std::cos(angle), turntable.radius * std::sin(angle),
                                 turntable.height);
    const Eigen::Vector3d ahead = -centre.normalized();
    const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
    Pose pose;
    pose.rotation << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
    pose.translation = -pose.rotation * centre;
    scene.views.push_back(make_view(std::to_string(i + 1), lens, pose));
  }
  return scene;
}

Scene guess_turntable(int given) {
  const int count = images_of(given);
  if (count < 5 || count > 100000) {
    throw nef::InputError("--turntable N without --K: from 5 to 100000 images, of one full turn in equal steps");
  }
  Scene scene = make_turntable({count, {1000, 500, 500}, 1, 0.3});
  scene.format = fmt::format("a turntable of {} degrees a step, its camera to be found", 360.0 / count);
  scene.guessed = true;
  return scene;
}

}  // namespace nef::visual_hull

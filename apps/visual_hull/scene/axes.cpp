// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/axes.h"

#include <algorithm>
#include <array>

#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

// A new coordinate is an old one, perhaps with the other sign.
struct Axis {
  std::size_t from = 0;
  int sign = 1;
};

// Cyclic shifts keep orientation; where z looks the wrong way, half a turn about the new x follows.
std::array<Axis, 3> axes_of(const std::string& up) {
  const std::size_t letter = up.size() == 2 && (up[0] == '-' || up[0] == '+') ? 1 : 0;
  if (up.size() != letter + 1 || up[letter] < 'x' || up[letter] > 'z') {
    throw nef::InputError("--up: x, y, z, -x, -y or -z is needed, not '" + up + "'");
  }
  const auto axis = static_cast<std::size_t>(up[letter] - 'x');
  const int sign = up[0] == '-' ? -1 : 1;
  return {{{(axis + 1) % 3, 1}, {(axis + 2) % 3, sign}, {axis, sign}}};
}

}  // namespace

void turn_up(Scene& scene, const std::string& up) {
  const std::array<Axis, 3> axes = axes_of(up);
  for (View& view : scene.views) {
    Matrix34 turned = view.camera.matrix();
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k) turned[row][k] = axes[k].sign * view.camera.matrix()[row][axes[k].from];
    }
    view.camera = Camera(view.camera.name(), turned);
  }
  if (!scene.box) return;
  const WorldBox old = *scene.box;
  for (std::size_t k = 0; k < 3; ++k) {
    scene.box->low[k] = axes[k].sign * old.low[axes[k].from];
    scene.box->high[k] = axes[k].sign * old.high[axes[k].from];
    if (axes[k].sign < 0) std::swap(scene.box->low[k], scene.box->high[k]);
  }
}

Camera moved(const Camera& camera, const Rational3& shift) {
  Matrix34 m = camera.matrix();
  for (std::array<Rational, 4>& row : m) {
    for (std::size_t k = 0; k < 3; ++k) row[3] += row[k] * shift[k];
  }
  return {camera.name(), m};
}

}  // namespace nef::visual_hull

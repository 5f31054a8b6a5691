// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include "apps/visual_hull/visual_hull.h"
int main() {
  // A camera at the origin that looks along +z sees a square; the box ends at depth 3.
  nef::visual_hull::Scene scene;
  nef::visual_hull::View view;
  view.polygons = std::vector<nef::visual_hull::Ring>{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  scene.views.push_back(view);
  scene.box = nef::visual_hull::WorldBox{{-9, -9, -9}, {9, 9, 3}};
  std::cout << *nef::volume(nef::visual_hull::compute(scene, {}, {}).hull) << '\n';  // 36
}

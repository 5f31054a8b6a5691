// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/place.h"

#include <algorithm>
#include <cmath>

#include "apps/visual_hull/scene/axes.h"
#include "apps/visual_hull/scene/understanding.h"

namespace nef::visual_hull {

Place place_of(const std::vector<Camera>& cameras) {
  Place place;
  place.cameras = cameras;
  std::vector<Sight> sights;
  for (const Camera& camera : cameras) sights.push_back(sight_of(camera));
  const auto point = common_point(sights);
  if (!point || !point->allFinite()) return place;
  double distance = 0;
  for (const Sight& s : sights) distance = std::max(distance, (*point - s.centre).norm());
  constexpr double kFar = 16;  // times the distance of the cameras; any choice is right
  if (!(point->cwiseAbs().maxCoeff() > kFar * distance) || !(distance > 0)) return place;
  const double step = std::exp2(std::floor(std::log2(distance)));
  for (int i = 0; i < 3; ++i) {
    place.shift[static_cast<std::size_t>(i)] = nef::exact_rational(std::round((*point)[i] / step) * step);
  }
  for (Camera& camera : place.cameras) camera = moved(camera, place.shift);
  return place;
}

}  // namespace nef::visual_hull

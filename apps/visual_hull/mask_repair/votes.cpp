// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/mask_repair/votes.h"

#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

constexpr int kVoteSide = 128;

}  // namespace

Votes vote(const std::vector<refine::MovingCamera>& cameras,
           const std::vector<std::optional<refine::Outline>>& outlines, const refine::Ball& ball, double margin,
           const nef::Monitor& monitor) {
  std::vector<std::size_t> voters;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (outlines[i]) voters.push_back(i);
  }
  const auto excludes = [&](std::size_t view, const Eigen::Vector3d& point) {
    const Eigen::Vector3d own = cameras[view].inward(point);
    return !(own.z() > 0) || outlines[view]->distance.value(cameras[view].seen(own)) < -margin;
  };
  Votes votes;
  votes.step = 2 * ball.radius / kVoteSide;
  const Eigen::Vector3d corner = ball.centre - Eigen::Vector3d::Constant(ball.radius - votes.step / 2);
  std::vector<std::vector<VotedPoint>> layers(kVoteSide);
  nef::parallel_for(layers.size(), monitor, [&](std::size_t z, const nef::Monitor& own) {
    std::size_t last = 0;  // the view that excluded the point before comes first: neighbours are much alike
    for (int y = 0; y < kVoteSide; ++y) {
      own.check_interruption();
      for (int x = 0; x < kVoteSide; ++x) {
        VotedPoint point{corner + votes.step * Eigen::Vector3d(x, y, static_cast<double>(z))};
        int against = 0;
        for (std::size_t k = 0; k < voters.size() && against < 3; ++k) {
          const std::size_t at = (last + k) % voters.size();
          if (!excludes(voters[at], point.at)) continue;
          ++against;
          if (against == 1) point.first = static_cast<std::uint16_t>(voters[at]);
          if (against == 2) point.second = static_cast<std::uint16_t>(voters[at]);
          if (against == 3) last = at;
        }
        if (against < 3) layers[z].push_back(point);
      }
    }
  });
  for (const std::vector<VotedPoint>& layer : layers) {
    votes.points.insert(votes.points.end(), layer.begin(), layer.end());
  }
  return votes;
}

}  // namespace nef::visual_hull

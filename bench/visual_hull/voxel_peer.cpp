// SPDX-License-Identifier: Apache-2.0
#include "bench/visual_hull/voxel_peer.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace nef::visual_hull::bench {

double carve(const std::vector<cv::Mat>& masks, const Result& result, int n) {
  std::array<double, 3> low{};
  std::array<double, 3> step{};
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = nef::nearest_double(result.box.low[k]);
    step[k] = (nef::nearest_double(result.box.high[k]) - low[k]) / n;
  }
  std::vector<std::array<std::array<double, 4>, 3>> matrices;
  for (const ViewResult& view : result.views) {
    matrices.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) matrices.back()[i][j] = nef::nearest_double(view.camera.matrix()[i][j]);
    }
  }
  const double shift = result.origin == PixelOrigin::kCenter ? 0.5 : 0;  // of the pixel's corner
  std::size_t kept = 0;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const std::array<double, 3> p{low[0] + (x + 0.5) * step[0], low[1] + (y + 0.5) * step[1],
                                      low[2] + (z + 0.5) * step[2]};
        bool inside = true;
        for (std::size_t v = 0; v < masks.size() && inside; ++v) {
          const auto& m = matrices[v];
          const double depth = m[2][0] * p[0] + m[2][1] * p[1] + m[2][2] * p[2] + m[2][3];
          const int u = cvFloor((m[0][0] * p[0] + m[0][1] * p[1] + m[0][2] * p[2] + m[0][3]) / depth + shift);
          const int w = cvFloor((m[1][0] * p[0] + m[1][1] * p[1] + m[1][2] * p[2] + m[1][3]) / depth + shift);
          inside = depth > 0 && u >= 0 && w >= 0 && u < masks[v].cols && w < masks[v].rows &&
                   masks[v].at<std::uint8_t>(w, u) != 0;
        }
        if (inside) ++kept;
      }
    }
  }
  return static_cast<double>(kept) * step[0] * step[1] * step[2];
}

std::vector<cv::Mat> drawn_masks(const Result& result, int width, int height) {
  constexpr int kShift = 6;  // coordinates of fillPoly have so many binary digits
  std::vector<cv::Mat> masks;
  for (const ViewResult& view : result.views) {
    std::vector<std::vector<cv::Point>> outlines;
    for (const Ring& ring : view.silhouette.region.rings) {
      std::vector<cv::Point>& outline = outlines.emplace_back();
      for (const Point2& p : ring) {
        outline.emplace_back(cvRound(std::ldexp(p.approximate[0], kShift)),
                             cvRound(std::ldexp(p.approximate[1], kShift)));
      }
    }
    masks.push_back(cv::Mat::zeros(height, width, CV_8U));
    cv::fillPoly(masks.back(), outlines, cv::Scalar(255), cv::LINE_8, kShift);
  }
  return masks;
}

}  // namespace nef::visual_hull::bench

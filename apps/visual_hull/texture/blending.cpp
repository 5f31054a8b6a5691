// SPDX-License-Identifier: Apache-2.0
//
// Three moving averages are nearly a Gaussian, and cost the same for each width. Differences and a mask of the texels
// that have one are smoothed alike; their quotient is the mean over the texels of the chart.
#include "apps/visual_hull/texture/blending.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

constexpr double kDeviation = 0.01;  // of the smoothing, as a part of the square root of the surface in texels

// Three averages over w texels have the variance (w * w - 1) / 4.
int width_of_average(const Texels& texels) {
  std::size_t used = 0;
  for (std::size_t texel = 0; texel < texels.size(); ++texel) {
    if (texels.triangle(texel) != Texels::kFree) ++used;
  }
  const double variance = kDeviation * kDeviation * static_cast<double>(used);
  return 2 * static_cast<int>(std::lround((std::sqrt(4 * variance + 1) - 1) / 2)) + 1;
}

cv::Mat smooth(cv::Mat image, int width) {
  for (int round = 0; round < 3; ++round) {
    cv::boxFilter(image, image, -1, {width, width}, {-1, -1}, false, cv::BORDER_CONSTANT);
  }
  return image;
}

void blend_chart(const Chart& chart, const MeanColors& means, int width, Texels& texels) {
  cv::Mat difference(chart.height, chart.width, CV_32FC3, cv::Scalar::all(0));
  cv::Mat known(chart.height, chart.width, CV_32F, cv::Scalar(0));
  const auto for_texels = [&](auto&& visit) {
    for (int y = 0; y < chart.height; ++y) {
      for (int x = 0; x < chart.width; ++x) {
        const std::size_t texel = texels.index(chart.x + x, chart.y + y);
        if (texels.triangle(texel) == Texels::kFree || texels.grade[texel] == TexelGrade::kNone) continue;
        visit(texel, difference.at<cv::Vec3f>(y, x), known.at<float>(y, x));
      }
    }
  };
  for_texels([&](std::size_t texel, cv::Vec3f& off, float& weight) {
    if (!means.known(texel)) return;
    weight = 1;
    const std::array<float, 3> mean = means.mean(texel);
    for (int c = 0; c < 3; ++c)
      off[c] = mean[static_cast<std::size_t>(c)] - texels.color[texel][static_cast<std::size_t>(c)];
  });
  difference = smooth(difference, width);
  known = smooth(known, width);
  for_texels([&](std::size_t texel, const cv::Vec3f& off, float weight) {
    constexpr float kNear = 1e-4F;
    if (!(weight > kNear)) return;
    for (std::size_t c = 0; c < 3; ++c) {
      float& channel = texels.color[texel][c];
      channel = std::clamp(channel + off[static_cast<int>(c)] / weight, 0.0F, 255.0F);
    }
  });
}

}  // namespace

void blend_views(const Atlas& atlas, const MeanColors& means, Texels& texels, const nef::Monitor& monitor) {
  const int width = width_of_average(texels);
  nef::parallel_for(atlas.charts.size(), monitor, [&](std::size_t i, const nef::Monitor&) {
    if (atlas.charts[i].view != kNoView) blend_chart(atlas.charts[i], means, width, texels);
  });
}

}  // namespace nef::visual_hull

// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/pictures/mask_overview.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/masks/measures.h"

namespace nef::visual_hull {
namespace {

constexpr int kSheetWidth = 1600;
constexpr int kTileSide = 320;
constexpr double kDimmed = 0.35;

cv::Mat tile_of(const std::filesystem::path& photograph, const cv::Mat& mask) {
  cv::Mat tile = read_picture(photograph, kTileSide);
  cv::Mat small;
  cv::resize(mask, small, tile.size(), 0, 0, cv::INTER_AREA);
  small = small > 127;
  cv::Mat dimmed = tile * kDimmed;
  tile.copyTo(dimmed, small);
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(small, outlines, cv::RETR_CCOMP, cv::CHAIN_APPROX_NONE);
  cv::drawContours(dimmed, outlines, -1, cv::Scalar(0, 0, 255));
  return dimmed;
}

}  // namespace

cv::Mat mask_overview(const std::vector<std::filesystem::path>& photographs, const std::vector<cv::Mat>& masks) {
  std::vector<cv::Mat> tiles;
  cv::Size cell(1, 1);
  for (std::size_t i = 0; i < photographs.size(); ++i) {
    tiles.push_back(tile_of(photographs[i], masks[i]));
    cell.width = std::max(cell.width, tiles.back().cols);
    cell.height = std::max(cell.height, tiles.back().rows);
  }
  const int columns = std::clamp(static_cast<int>(tiles.size()), 1, kSheetWidth / cell.width);
  const int rows = (static_cast<int>(tiles.size()) + columns - 1) / columns;
  cv::Mat sheet(rows * cell.height, columns * cell.width, CV_8UC3, cv::Scalar(255, 255, 255));
  for (int i = 0; i < static_cast<int>(tiles.size()); ++i) {
    const cv::Mat& tile = tiles[static_cast<std::size_t>(i)];
    const cv::Point corner(i % columns * cell.width, i / columns * cell.height);
    tile.copyTo(sheet(cv::Rect(corner, tile.size())));
  }
  return sheet;
}

}  // namespace nef::visual_hull

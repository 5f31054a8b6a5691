// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/calibrate/find_board.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/calibrate/board_definition.h"

namespace nef::visual_hull {
namespace {

constexpr int kSmallPicture = 2000;  // pixels along its longer side

}  // namespace

SeenBoard find_board(const cv::Mat& picture, const Board& board) {
  const auto definition = board_definition(board);
  cv::Mat gray;
  cv::cvtColor(picture, gray, cv::COLOR_BGR2GRAY);
  // Cells of markers of a few pixels are read better from a larger copy, and their corners lie better there.
  const double scale = std::max(gray.cols, gray.rows) < kSmallPicture ? 2 : 1;
  if (scale > 1) cv::resize(gray, gray, cv::Size(), scale, scale, cv::INTER_CUBIC);
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  cv::aruco::detectMarkers(gray, definition->dictionary, markers, ids, cv::aruco::DetectorParameters::create());
  SeenBoard seen;
  if (ids.size() < 2) return seen;
  std::vector<cv::Point2f> points;
  std::vector<int> numbers;
  cv::aruco::interpolateCornersCharuco(markers, ids, gray, definition, points, numbers);
  const std::vector<Eigen::Vector3d> corners = board_corners(board);
  // Whole numbers are centres of pixels in both.
  const auto in_picture = [scale](const cv::Point2f& p) {
    return cv::Point2d((p.x + 0.5) / scale - 0.5, (p.y + 0.5) / scale - 0.5);
  };
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Eigen::Vector3d& corner = corners[static_cast<std::size_t>(numbers[k])];
    seen.corners.emplace_back(corner.x(), corner.y(), corner.z());
    seen.points.push_back(in_picture(points[k]));
  }
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const auto number = std::find(definition->ids.begin(), definition->ids.end(), ids[k]) - definition->ids.begin();
    if (number == static_cast<std::ptrdiff_t>(definition->ids.size())) continue;  // of another board
    const std::vector<cv::Point3f>& marker = definition->objPoints[static_cast<std::size_t>(number)];
    for (std::size_t i = 0; i < marker.size(); ++i) {
      seen.marker_corners.emplace_back(marker[i].x - board.width() / 2, board.height() / 2 - marker[i].y, 0);
      seen.marker_points.push_back(in_picture(markers[k][i]));
    }
  }
  return seen;
}

}  // namespace nef::visual_hull

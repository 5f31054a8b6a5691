// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/calibrate/opencv_camera.h"

#include <opencv2/calib3d.hpp>

namespace nef::visual_hull {

cv::Mat opencv_matrix(const Lens& lens) {
  return (cv::Mat_<double>(3, 3) << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1);
}

OpenCvPose OpenCvPose::of(const Pose& pose) {
  const Eigen::Matrix3d& r = pose.rotation;
  const cv::Matx33d matrix(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
  OpenCvPose result;
  cv::Rodrigues(matrix, result.rotation);
  const Eigen::Vector3d& t = pose.translation;
  result.shift = (cv::Mat_<double>(3, 1) << t.x(), t.y(), t.z());
  return result;
}

Pose OpenCvPose::pose() const {
  cv::Mat r;
  cv::Rodrigues(rotation, r);
  Pose result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.rotation(i, j) = r.at<double>(i, j);
    result.translation[i] = shift.at<double>(i);
  }
  return result;
}

std::vector<cv::Point2d> seen_points(const std::vector<cv::Point3d>& points, const Lens& lens, const OpenCvPose& pose) {
  std::vector<cv::Point2d> seen;
  if (points.empty()) return seen;
  cv::projectPoints(points, pose.rotation, pose.shift, opencv_matrix(lens), lens.distortion, seen);
  return seen;
}

cv::Mat derivatives_of_seen(const std::vector<cv::Point3d>& points, const Lens& lens, const OpenCvPose& pose) {
  std::vector<cv::Point2d> seen;
  cv::Mat j;
  cv::projectPoints(points, pose.rotation, pose.shift, opencv_matrix(lens), lens.distortion, seen, j);
  return j;
}

}  // namespace nef::visual_hull

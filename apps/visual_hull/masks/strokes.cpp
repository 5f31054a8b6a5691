// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/masks/strokes.h"

#include <opencv2/imgproc.hpp>
#include <system_error>

#include "apps/visual_hull/masks/grab_cut.h"
#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

namespace fs = std::filesystem;

constexpr int kBrushReach = 60;  // of 255

cv::Mat painted(const cv::Mat& strokes, const cv::Scalar& color) {
  const cv::Scalar reach = cv::Scalar::all(kBrushReach);
  cv::Mat result;
  cv::inRange(strokes, color - reach, color + reach, result);
  return result;
}

cv::Mat distance_to(const cv::Mat& stroke) {
  cv::Mat distance;
  cv::distanceTransform(stroke == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance;
}

}  // namespace

fs::path strokes_of(const fs::path& path, const fs::path& photograph) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    throw nef::InputError("--mask grabcut: there is no " + path.string() +
                          ": name a picture with strokes, or a folder of such pictures");
  }
  if (!fs::is_directory(path, error)) return path;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (entry.path().stem() == photograph.stem()) return entry.path();
  }
  if (error) throw nef::InputError("--mask grabcut: " + path.string() + " cannot be read (" + error.message() + ")");
  return {};
}

cv::Mat seeds_from_strokes(const cv::Mat& strokes, const std::string& what) {
  const cv::Mat object = painted(strokes, {0, 255, 0});
  cv::Mat background = painted(strokes, {0, 0, 255});
  if (cv::countNonZero(object) == 0) {
    throw nef::InputError(what + ": no stroke of #00FF00 (green) is there: paint one over the object, and one of " +
                          "#FF0000 (red) over the background");
  }
  if (cv::countNonZero(background) == 0) {
    background.setTo(255);
    background(inside_margins(background.size())).setTo(0);
    background.setTo(0, object);
  }
  cv::Mat seeds(strokes.size(), CV_8U, cv::Scalar(cv::GC_PR_BGD));
  seeds.setTo(cv::Scalar(cv::GC_PR_FGD), distance_to(object) < distance_to(background));
  seeds.setTo(cv::Scalar(cv::GC_FGD), object);
  seeds.setTo(cv::Scalar(cv::GC_BGD), background);
  return seeds;
}

}  // namespace nef::visual_hull

// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/silhouette/channel.h"

#include <array>
#include <opencv2/imgproc.hpp>

#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

using Channel = ThresholdOptions::Channel;

// OpenCV's order of channels.
constexpr int kBlueAt = 0;
constexpr int kGreenAt = 1;
constexpr int kRedAt = 2;
constexpr int kAlphaAt = 3;

cv::Mat to_gray(const cv::Mat& image) {
  cv::Mat gray;
  if (image.channels() == 1) {
    gray = image;
  } else if (image.depth() == CV_8U || image.depth() == CV_16U || image.depth() == CV_32F) {
    cv::cvtColor(image, gray, image.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  } else {
    cv::extractChannel(image, gray, 0);
  }
  return gray;
}

cv::Mat plane(const cv::Mat& image, int index) {
  if (index >= image.channels()) {
    throw nef::InputError("the image has " + std::to_string(image.channels()) +
                          " channels only, not the one that --channel names");
  }
  cv::Mat picked;
  cv::extractChannel(image, picked, index);
  return picked;
}

cv::Mat difference(const cv::Mat& image, int a, int b) {
  cv::Mat result;
  cv::addWeighted(plane(image, a), 0.5, plane(image, b), -0.5, full_scale(image.depth()) / 2, result);
  return result;
}

// The largest and the least of red, green and blue.
std::array<cv::Mat, 2> extremes(const cv::Mat& image) {
  std::array<cv::Mat, 2> result{plane(image, kBlueAt).clone(), plane(image, kBlueAt).clone()};
  for (const int index : {kGreenAt, kRedAt}) {
    const cv::Mat other = plane(image, index);
    cv::max(result[0], other, result[0]);
    cv::min(result[1], other, result[1]);
  }
  return result;
}

cv::Mat saturation(const cv::Mat& image) {
  const auto [high, low] = extremes(image);
  cv::Mat range = high - low;
  cv::Mat result;
  cv::divide(range, high, result, full_scale(image.depth()));  // 0 for integers where the value is
  return result;
}

}  // namespace

double full_scale(int depth) {
  switch (depth) {
    case CV_8U:
      return 255;
    case CV_8S:
      return 127;
    case CV_16U:
      return 65535;
    case CV_16S:
      return 32767;
    case CV_32S:
      return 2147483647;
    default:
      return 1;
  }
}

cv::Mat pick_channel(const cv::Mat& image, Channel channel) {
  switch (channel) {
    case Channel::kGray:
      return to_gray(image);
    case Channel::kRed:
      return plane(image, kRedAt);
    case Channel::kGreen:
      return plane(image, kGreenAt);
    case Channel::kBlue:
      return plane(image, kBlueAt);
    case Channel::kAlpha:
      return plane(image, kAlphaAt);
    case Channel::kValue:
      return extremes(image)[0];
    case Channel::kSaturation:
      return saturation(image);
    case Channel::kRedBlue:
      return difference(image, kRedAt, kBlueAt);
    case Channel::kRedGreen:
      return difference(image, kRedAt, kGreenAt);
    case Channel::kGreenBlue:
      return difference(image, kGreenAt, kBlueAt);
  }
  return {};
}

}  // namespace nef::visual_hull

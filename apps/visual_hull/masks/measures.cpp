// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/masks/measures.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/scene/image_file.h"
#include "apps/visual_hull/silhouette/channel.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"

namespace nef::visual_hull {
namespace {

/// Brightness of the same colour, as a factor.
struct Brightness {
  float least = 1;
  float most = 1;
};

// The distance of a colour from the nearest brightness of another one.
unsigned char distance_of(const cv::Vec3b& color, const cv::Vec3b& from, const Brightness& range) {
  const cv::Vec3f p(color);
  const cv::Vec3f b(from);
  const float square = b.dot(b);
  const float factor = square > 0 ? std::clamp(p.dot(b) / square, range.least, range.most) : 1;
  return cv::saturate_cast<unsigned char>(cv::norm(p - factor * b));
}

cv::Mat distances(const cv::Mat& picture, const std::function<cv::Vec3b(int y, int x)>& from, const Brightness& range) {
  cv::Mat result(picture.size(), CV_8U);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      result.at<unsigned char>(y, x) = distance_of(picture.at<cv::Vec3b>(y, x), from(y, x), range);
    }
  }
  return result;
}

}  // namespace

Measure channel_measure(ThresholdOptions::Channel channel, bool inverted) {
  const std::string name = channel_names()[static_cast<std::size_t>(channel)];
  return {(inverted ? "darkness of " : "") + name, [channel, inverted](const cv::Mat& picture) -> cv::Mat {
            const cv::Mat values = pick_channel(picture, channel);
            return inverted ? cv::Mat(255 - values) : values;
          }};
}

std::vector<Measure> channel_measures() {
  std::vector<Measure> measures;
  for (std::size_t i = 0; i < channel_names().size(); ++i) {
    const auto channel = static_cast<ThresholdOptions::Channel>(i);
    if (channel == ThresholdOptions::Channel::kAlpha) continue;
    for (const bool inverted : {false, true}) measures.push_back(channel_measure(channel, inverted));
  }
  return measures;
}

Measure background_measure(const cv::Mat& background) {
  return {"distance from the background", [background](const cv::Mat& picture) {
            cv::Mat scaled = background;
            if (background.size() != picture.size()) {
              cv::resize(background, scaled, picture.size(), 0, 0, cv::INTER_AREA);
            }
            return distances(picture, [&scaled](int y, int x) { return scaled.at<cv::Vec3b>(y, x); }, {0.4F, 1});
          }};
}

Measure key_measure(const std::array<int, 3>& key) {
  const cv::Vec3b color(static_cast<unsigned char>(key[2]), static_cast<unsigned char>(key[1]),
                        static_cast<unsigned char>(key[0]));
  return {"distance from the key colour", [color](const cv::Mat& picture) {
            return distances(picture, [&color](int, int) { return color; }, {0.2F, 1.6F});
          }};
}

cv::Mat median_picture(const std::vector<cv::Mat>& pictures) {
  cv::Mat result(pictures.at(0).size(), CV_8UC3);
  const std::size_t middle = pictures.size() / 2;
  std::vector<unsigned char> values(pictures.size());
  for (int y = 0; y < result.rows; ++y) {
    unsigned char* const row = result.ptr(y);
    for (int i = 0; i < 3 * result.cols; ++i) {
      for (std::size_t k = 0; k < pictures.size(); ++k) values[k] = pictures[k].ptr(y)[i];
      std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(middle), values.end());
      row[i] = values[middle];
    }
  }
  return result;
}

cv::Mat read_picture(const std::filesystem::path& file, int longest) {
  nef::require_readable_file(file.string());
  cv::Mat picture = read_colors(file);
  if (picture.empty())
    throw nef::InputError(file.string() + ": cannot be read as an image; name PNG or JPEG files, or a folder of them");
  const int side = std::max(picture.rows, picture.cols);
  if (longest > 0 && side > longest) {
    const double scale = static_cast<double>(longest) / side;
    cv::resize(picture, picture, cv::Size(), scale, scale, cv::INTER_AREA);
  }
  return picture;
}

}  // namespace nef::visual_hull

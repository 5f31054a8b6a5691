// SPDX-License-Identifier: Apache-2.0
//
// Image -> mask -> contours -> silhouette. The mask compares a channel with a threshold (half of the range, a number,
// or Otsu's). Its contours are traced along pixel borders, or, for soft masks, at half opacity between centres; small
// ones are dropped, the distortion of the lens is undone on the contours, and they are simplified. If a silhouette that
// the frame cuts may go on beyond it, the background is taken instead: the mask is padded by one pixel of object, so
// that what the outermost ring contains and the silhouette does not is the background that is seen for sure.
#include "apps/visual_hull/silhouette/silhouette.h"

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>

#include "apps/visual_hull/scene/image_file.h"
#include "apps/visual_hull/silhouette/channel.h"
#include "apps/visual_hull/silhouette/half_contour.h"
#include "apps/visual_hull/silhouette/lens.h"
#include "apps/visual_hull/silhouette/opacity.h"
#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

/// What a threshold compares.
struct Levelled {
  cv::Mat values;  ///< one channel
  double level;    ///< of the largest value that is background
};

Levelled by_default(const cv::Mat& image, ThresholdOptions::Channel channel) {
  const double half = full_scale(image.depth()) / 2;
  if (image.channels() == 4 && channel == ThresholdOptions::Channel::kGray) {
    cv::Mat alpha;
    cv::extractChannel(image, alpha, 3);
    double low = 0;
    double high = 0;
    cv::minMaxLoc(alpha, &low, &high);
    if (low < high) return {alpha, half};
  }
  return {pick_channel(image, channel), half};
}

Levelled by_otsu(cv::Mat gray) {
  if (gray.depth() != CV_8U) gray.convertTo(gray, CV_8U, 255 / full_scale(gray.depth()));
  cv::Mat unused;
  const double level = cv::threshold(gray, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  return {gray, level};
}

Levelled levelled(const cv::Mat& image, const ThresholdOptions& options) {
  switch (options.kind) {
    case ThresholdOptions::Kind::kOtsu:
      return by_otsu(pick_channel(image, options.channel));
    case ThresholdOptions::Kind::kValue:
      return {pick_channel(image, options.channel), options.value};
    case ThresholdOptions::Kind::kDefault:
      break;
  }
  return by_default(image, options.channel);
}

// Drops contours around less than `least`. What lies inside such a contour is smaller still, so parity stays right. A
// silhouette that must not lose anything (`outer`) keeps its islands.
Silhouette without_specks(Silhouette traced, double least, bool outer, const nef::Monitor& monitor) {
  if (least <= 0) return traced;
  std::vector<bool> small;
  small.reserve(traced.rings.size());
  for (const Ring& ring : traced.rings) small.push_back(std::abs(twice_area(ring)) < 2 * least);
  std::vector<Ring> kept;
  for (std::size_t i = 0; i < traced.rings.size(); ++i) {
    const bool island = traced.depth[i] % 2 == 0;
    const int hole = traced.parent[i];
    const bool in_filled_hole = hole >= 0 && small[static_cast<std::size_t>(hole)];
    if (!small[i] || (outer && island && !in_filled_hole)) kept.push_back(std::move(traced.rings[i]));
  }
  return nest(std::move(kept), monitor);
}

Silhouette traced_without_specks(const cv::Mat& mask, const SilhouetteOptions& options, const nef::Monitor& monitor) {
  Silhouette traced = options.soft ? trace_half_contours(mask, options.origin, monitor)
                                   : trace_contours(mask, options.origin, options.diagonal, monitor);
  return without_specks(std::move(traced), options.min_area, options.simplify.outer, monitor);
}

// The silhouette with all that is not seen, on a frame that is one pixel larger; then what is
// inside its outermost ring but not in it: the background that is seen for sure.
Silhouette seen_background(const cv::Mat& mask, const Distortion& lens, const std::string& view,
                           const SilhouetteOptions& options, ViewSilhouette& result, const nef::Monitor& monitor) {
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(255));
  Silhouette traced = traced_without_specks(padded, options, monitor);
  for (Ring& ring : traced.rings) {  // the frame has grown by one pixel to the left and above
    for (Point2& p : ring) p = Point2(p.x() - 1, p.y() - 1);
  }
  result.contour_vertices = traced.vertex_count();
  if (!lens.coefficients.empty()) {
    const auto frame = std::find(traced.depth.begin(), traced.depth.end(), 0) - traced.depth.begin();
    traced = straighten(traced, lens, view, static_cast<std::size_t>(frame), monitor);
  }
  Silhouette simple = simplify(traced, options.simplify, monitor);
  std::vector<Ring> rings;
  for (std::size_t i = 0; i < simple.rings.size(); ++i) {
    if (simple.depth[i] > 0) rings.push_back(std::move(simple.rings[i]));
  }
  return nest(std::move(rings), monitor);
}

}  // namespace

cv::Mat opencv_intrinsics(const Distortion& distortion, PixelOrigin origin) {
  cv::Mat k(3, 3, CV_64F);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      k.at<double>(i, j) =
          nef::nearest_double(distortion.intrinsics[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
    }
  }
  if (origin == PixelOrigin::kCorner) {  // OpenCV's whole coordinates are centres
    k.at<double>(0, 2) -= 0.5;
    k.at<double>(1, 2) -= 0.5;
  }
  return k;
}

cv::Mat read_photograph(const std::filesystem::path& image, const Distortion& distortion, PixelOrigin origin) {
  cv::Mat photograph = read_colors(image);
  if (photograph.empty() || distortion.coefficients.empty()) return photograph;
  cv::Mat straight;
  cv::undistort(photograph, straight, opencv_intrinsics(distortion, origin), distortion.coefficients);
  return straight;
}

cv::Mat make_mask(const cv::Mat& image, const ThresholdOptions& options) {
  const Levelled found = levelled(image, options);
  cv::Mat mask = found.values > found.level;
  if (options.invert) cv::bitwise_not(mask, mask);
  return mask;
}

cv::Mat make_opacity(const cv::Mat& image, const ThresholdOptions& options) {
  const Levelled found = levelled(image, options);
  cv::Mat opacity = opacity_of(found.values, found.level, full_scale(found.values.depth()), found.values > found.level);
  if (options.invert) cv::bitwise_not(opacity, opacity);
  return opacity;
}

cv::Mat read_mask(const std::filesystem::path& image, const std::string& view, const SilhouetteOptions& options) {
  const cv::Mat pixels = read_pixels(image);
  if (pixels.empty()) {
    throw nef::InputError("view " + view + ": cannot read the image " + image.string() +
                          ": it is damaged, cut off, too large, or of no format that is known");
  }
  cv::Mat mask;
  try {
    mask = options.soft ? make_opacity(pixels, options.threshold) : make_mask(pixels, options.threshold);
  } catch (const nef::InputError& error) {
    throw nef::InputError("view " + view + ": " + image.string() + ": " + error.what());
  }
  if (cv::countNonZero(object_of(mask)) == 0) {
    double low = 0;
    double high = 0;
    cv::minMaxLoc(pick_channel(pixels, options.threshold.channel), &low, &high);
    std::ostringstream range;
    range << low << " to " << high;
    throw nef::InputError("view " + view + ": the silhouette is empty (values of " + image.string() + " go from " +
                          range.str() + "; see --threshold, --channel and --invert; photographs need --mask auto)");
  }
  return mask;
}

ViewSilhouette silhouette_of_mask(const cv::Mat& mask, const Distortion& lens, const std::string& view,
                                  const SilhouetteOptions& options, const nef::Monitor& monitor) {
  const cv::Mat object = options.soft ? object_of(mask) : mask;
  if (cv::countNonZero(object) == 0) throw nef::InputError("view " + view + ": the silhouette is empty");
  ViewSilhouette result;
  result.image_size = mask.size();
  Silhouette traced = traced_without_specks(mask, options, monitor);
  if (traced.empty()) {
    throw nef::InputError("view " + view + ": the silhouette is empty without contours of less than " +
                          std::to_string(options.min_area) + " square pixels (--min-area)");
  }
  result.contours = traced.rings.size();
  result.holes = traced.hole_count();
  result.contour_vertices = traced.vertex_count();
  result.cut_by_frame = touches_frame(object);
  result.background = result.cut_by_frame && options.border == Border::kUnknown;
  if (result.background) {
    result.region = seen_background(mask, lens, view, options, result, monitor);
    return result;
  }
  if (!lens.coefficients.empty()) traced = straighten(traced, lens, view, std::nullopt, monitor);
  result.region = simplify(traced, options.simplify, monitor);
  return result;
}

ViewSilhouette silhouette_of_polygons(const std::vector<Ring>& polygons, const std::string& view,
                                      const SilhouetteOptions& options, const nef::Monitor& monitor) {
  if (polygons.empty()) throw nef::InputError("view " + view + ": the silhouette is empty");
  ViewSilhouette result;
  const Silhouette nested = make_silhouette(polygons, "view " + view, monitor);
  result.contours = nested.rings.size();
  result.holes = nested.hole_count();
  result.contour_vertices = nested.vertex_count();
  result.region = simplify(nested, options.simplify, monitor);
  return result;
}

}  // namespace nef::visual_hull

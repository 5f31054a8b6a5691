// SPDX-License-Identifier: Apache-2.0
//
// The silhouette's polygons are drawn as pixels and eroded by two; the mesh is drawn into a depth map, triangle by
// triangle. Colours are looked up in the photograph, whose lens distortion was undone before.
#include "apps/visual_hull/color/photo_view.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "nef/base/error.h"

namespace nef::visual_hull {
namespace {

cv::Mat load_photograph(const ViewResult& view, PixelOrigin origin) {
  const std::filesystem::path file = photograph_of(view.image);
  cv::Mat image = read_photograph(file, view.distortion, origin);
  if (image.empty()) throw nef::InputError("view " + view.name + ": cannot read the image " + file.string());
  if (image.size() != view.silhouette.image_size) {
    throw nef::InputError("view " + view.name + ": " + file.string() + " differs in size from the silhouette's image");
  }
  return image;
}

// The silhouette's pixels, and those of them all whose neighbours are in it, too.
std::array<cv::Mat, 2> pixels_of(const ViewResult& view, PixelOrigin origin) {
  constexpr int kShift = 4;  // sixteenths of a pixel
  const double shift = origin == PixelOrigin::kCorner ? -0.5 : 0;
  std::vector<std::vector<cv::Point>> rings;
  for (const Ring& ring : view.silhouette.region.rings) {
    rings.emplace_back();
    for (const Point2& p : ring) {
      rings.back().emplace_back(static_cast<int>(std::lround((p.approximate[0] + shift) * (1 << kShift))),
                                static_cast<int>(std::lround((p.approximate[1] + shift) * (1 << kShift))));
    }
  }
  cv::Mat all(view.silhouette.image_size, CV_8U, cv::Scalar(0));
  cv::fillPoly(all, rings, cv::Scalar(255), cv::LINE_8, kShift);
  if (view.silhouette.background) cv::bitwise_not(all, all);
  cv::Mat inner;
  cv::erode(all, inner, cv::Mat::ones(5, 5, CV_8U), cv::Point(-1, -1), 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  return {all, inner};
}

std::array<double, 3> color_of(const cv::Vec3b& pixel) {  // OpenCV: blue, green, red
  return {static_cast<double>(pixel[2]), static_cast<double>(pixel[1]), static_cast<double>(pixel[0])};
}

// At the border the pixel of the silhouette that is nearest.
std::optional<cv::Vec3b> nearest_inside(const cv::Mat& image, const cv::Mat& pixels, int x, int y) {
  int least = INT_MAX;
  cv::Vec3b color;
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const int distance = dx * dx + dy * dy;
      const cv::Point at(x + dx, y + dy);
      if (distance >= least || !cv::Rect(cv::Point(), image.size()).contains(at)) continue;
      if (pixels.at<std::uint8_t>(at) == 0) continue;
      least = distance;
      color = image.at<cv::Vec3b>(at);
    }
  }
  if (least == INT_MAX) return std::nullopt;
  return color;
}

}  // namespace

std::filesystem::path photograph_of(const std::filesystem::path& image) {
  const std::filesystem::path folder = image.parent_path();
  if (folder.filename() != "masks" && folder.filename() != "silhouettes") return image;
  const std::filesystem::path above = folder.parent_path();
  return look_up_image({above / "images", above}, image.stem().string()).value_or(image);
}

std::vector<const ViewResult*> views_with_images(const std::vector<ViewResult>& views, const std::string& option) {
  std::vector<const ViewResult*> seeing;
  for (const ViewResult& view : views) {
    if (!view.image.empty()) seeing.push_back(&view);
  }
  if (seeing.empty()) throw nef::InputError(option + " needs images; the views are polygons");
  return seeing;
}

std::vector<std::array<double, 3>> rounded_points(const nef::Mesh& mesh) {
  std::vector<std::array<double, 3>> points;
  points.reserve(mesh.vertices.size());
  for (const nef::Rational3& p : mesh.vertices) {
    points.push_back({nef::nearest_double(p[0]), nef::nearest_double(p[1]), nef::nearest_double(p[2])});
  }
  return points;
}

PhotoView::PhotoView(const ViewResult& view, PixelOrigin origin, const nef::Mesh& mesh,
                     const std::vector<std::array<double, 3>>& points, const std::string& option)
    : image_(load_photograph(view, origin)),
      pixels_(pixels_of(view, origin)),
      projection_(view.camera, origin, option),
      depths_(projection_.pixel_width(), image_.cols, image_.rows) {
  std::vector<std::optional<ImagePlace>> places;
  places.reserve(points.size());
  for (const auto& point : points) places.push_back(projection_(point));
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      depths_.draw({places[face[0]], places[face[k]], places[face[k + 1]]});
    }
  }
}

std::optional<PhotoView::Sample> PhotoView::pixel_at(const ImagePlace& place) const {
  const int x = static_cast<int>(std::lround(place.u));
  const int y = static_cast<int>(std::lround(place.v));
  if (!cv::Rect(cv::Point(), image_.size()).contains({x, y})) return std::nullopt;
  if (pixels_[1].at<std::uint8_t>(y, x) != 0) return Sample{color_of(image_.at<cv::Vec3b>(y, x)), true};
  const auto color = nearest_inside(image_, pixels_[0], x, y);
  if (!color) return std::nullopt;
  return Sample{color_of(*color), false};
}

std::optional<PhotoView::Sample> PhotoView::blend_at(const ImagePlace& place) const {
  const int x = static_cast<int>(std::floor(place.u));
  const int y = static_cast<int>(std::floor(place.v));
  const double s = place.u - x;
  const double t = place.v - y;
  Sample sample{{}, true};
  for (const int dy : {0, 1}) {
    for (const int dx : {0, 1}) {
      const double weight = (dx == 1 ? s : 1 - s) * (dy == 1 ? t : 1 - t);
      const cv::Point at(x + dx, y + dy);
      if (!cv::Rect(cv::Point(), image_.size()).contains(at)) return pixel_at(place);
      if (pixels_[1].at<std::uint8_t>(at) == 0) return pixel_at(place);
      const std::array<double, 3> color = color_of(image_.at<cv::Vec3b>(at));
      for (std::size_t i = 0; i < 3; ++i) sample.color[i] += weight * color[i];
    }
  }
  return sample;
}

}  // namespace nef::visual_hull

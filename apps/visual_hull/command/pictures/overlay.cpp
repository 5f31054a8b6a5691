// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/command/pictures/overlay.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/command/photographs.h"
#include "apps/visual_hull/polygon/edge_grid.h"
#include "nef/io/file_bytes.h"
#include "nef/polyhedron.h"

namespace nef::visual_hull {
namespace {

using Vec = std::array<double, 2>;
constexpr int kShift = 4;  // OpenCV draws to sixteenths of a pixel

/// From image coordinates to those of OpenCV's drawing, whose whole numbers are centres of pixels.
struct Frame {
  double scale = 1;
  double u0 = 0;
  double v0 = 0;

  cv::Point operator()(const Vec& p) const {
    const auto fixed = [](double value) { return static_cast<int>(std::clamp(value, -1e5, 1e5) * (1 << kShift)); };
    return {fixed((p[0] - u0) * scale), fixed((p[1] - v0) * scale)};
  }
};

cv::Mat load_canvas(const ViewResult& view, PixelOrigin origin, Frame& frame) {
  if (!view.image.empty()) {
    cv::Mat image = read_photograph(view.image, view.distortion, origin);
    if (!image.empty()) {
      if (origin == PixelOrigin::kCorner) frame.u0 = frame.v0 = 0.5;
      return image;
    }
  }
  Rectangle box;
  for (const Ring& ring : view.silhouette.region.rings) {
    for (const Point2& p : ring) box.add(p.approximate);
  }
  const double width = box.high[0] - box.low[0];
  const double height = box.high[1] - box.low[1];
  constexpr double kLong = 760;
  constexpr double kMargin = 20;
  frame.scale = kLong / std::max(width, height);
  frame.u0 = box.low[0] - kMargin / frame.scale;
  frame.v0 = box.low[1] - kMargin / frame.scale;
  return {static_cast<int>(height * frame.scale + 2 * kMargin), static_cast<int>(width * frame.scale + 2 * kMargin),
          CV_8UC3, cv::Scalar(255, 255, 255)};
}

// Names of views may hold folders and what not.
std::string file_name(const ViewResult& view, std::size_t index) {
  const std::filesystem::path path(view.name);
  std::string name = (path.extension() == view.image.extension() ? path.stem() : path.filename()).string();
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.') c = '_';
  }
  const std::string number = std::to_string(index + 1);
  return std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number + "_" + name + ".png";
}

// What the silhouette has and the projection of the hull has not, in yellow.
void mark_residual(cv::Mat& picture, const cv::Mat& covered, const ViewResult& view, const Frame& frame) {
  if (view.silhouette.background) return;
  cv::Mat residual(picture.size(), CV_8U, cv::Scalar(0));
  std::vector<std::vector<cv::Point>> rings;
  for (const Ring& ring : view.silhouette.region.rings) {
    rings.emplace_back();
    for (const Point2& p : ring) rings.back().push_back(frame(p.approximate));
  }
  cv::fillPoly(residual, rings, cv::Scalar(255), cv::LINE_8, kShift);
  residual.setTo(cv::Scalar(0), covered);
  picture.setTo(cv::Scalar(0, 220, 255), residual);
}

}  // namespace

cv::Mat draw_overlay(const ViewResult& view, const nef::Polyhedron& hull, PixelOrigin origin) {
  Frame frame;
  cv::Mat canvas = load_canvas(view, origin, frame);
  cv::Mat filled = canvas.clone();
  cv::Mat covered(canvas.size(), CV_8U, cv::Scalar(0));
  std::vector<std::vector<cv::Point>> lines;
  for (const auto& facet : project_facets(hull, view.camera)) {
    std::vector<std::vector<cv::Point>> cycles;
    for (const auto& cycle : facet) {
      cycles.emplace_back();
      for (const Vec& p : cycle) cycles.back().push_back(frame(p));
    }
    cv::fillPoly(filled, cycles, cv::Scalar(230, 120, 40), cv::LINE_8, kShift);
    cv::fillPoly(covered, cycles, cv::Scalar(255), cv::LINE_8, kShift);
    lines.insert(lines.end(), cycles.begin(), cycles.end());
  }
  cv::polylines(filled, lines, true, cv::Scalar(140, 60, 0), 1, cv::LINE_AA, kShift);
  if (!hull.is_empty()) mark_residual(filled, covered, view, frame);
  cv::addWeighted(canvas, 0.5, filled, 0.5, 0, canvas);
  std::vector<std::vector<cv::Point>> outline;
  for (const Ring& ring : view.silhouette.region.rings) {
    outline.emplace_back();
    for (const Point2& p : ring) outline.back().push_back(frame(p.approximate));
  }
  cv::polylines(canvas, outline, true, cv::Scalar(0, 0, 255), 1, cv::LINE_AA, kShift);
  return canvas;
}

nef::view::Image image_of(const cv::Mat& picture) {
  nef::view::Image image{static_cast<std::uint32_t>(picture.cols), static_cast<std::uint32_t>(picture.rows), {}};
  image.rgb.resize(3 * picture.total());
  cv::cvtColor(picture, cv::Mat(picture.size(), CV_8UC3, image.rgb.data()), cv::COLOR_BGR2RGB);
  return image;
}

std::string png_of(const cv::Mat& picture) { return nef::view::png_bytes(image_of(picture)); }

void write_overlays(const Result& result, PixelOrigin origin, const std::filesystem::path& folder) {
  make_folder("--overlay", folder);
  for (std::size_t i = 0; i < result.views.size(); ++i) {
    const std::filesystem::path file = folder / file_name(result.views[i], i);
    nef::write_file(file.string(), png_of(draw_overlay(result.views[i], result.hull, origin)));
  }
}

}  // namespace nef::visual_hull

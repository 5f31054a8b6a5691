// SPDX-License-Identifier: Apache-2.0
//
// For each view: draw the mesh into a depth map, look up the pixel of each vertex that the view sees, and add its
// colour to the sums of the vertex. Views are processed in parallel; colours are whole numbers, so the order of the
// sums does not matter. Vertices without a colour take the mean of their neighbours in rounds, breadth first.
#include "apps/visual_hull/color/vertex_colors.h"

#include <cmath>
#include <mutex>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/color/depth_map.h"
#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

using Points = std::vector<std::array<double, 3>>;

/// Sums of colours: of views that see a vertex well inside of their silhouette, and of those that see it at its border.
struct Sum {
  std::array<double, 3> inside{};
  std::array<double, 3> border{};
  std::uint32_t inside_views = 0;
  std::uint32_t border_views = 0;
};

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

void add(std::array<double, 3>& sum, const cv::Vec3b& pixel) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] += pixel[2 - static_cast<int>(i)];  // OpenCV: blue, green, red
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

/// What one view says about the vertices.
class ViewColors {
 public:
  ViewColors(const ViewResult& view, PixelOrigin origin, const nef::Mesh& mesh, const Points& points)
      : image_(load_photograph(view, origin)),
        pixels_(pixels_of(view, origin)),
        depths_(view.camera, origin, image_.cols, image_.rows) {
    for (const auto& point : points) places_.push_back(depths_.project(point));
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      for (std::size_t k = 1; k + 1 < face.size(); ++k) {
        depths_.draw({places_[face[0]], places_[face[k]], places_[face[k + 1]]});
      }
    }
  }

  void add_to(std::vector<Sum>& sums) const {
    for (std::size_t v = 0; v < places_.size(); ++v) {
      if (!places_[v] || !depths_.sees(*places_[v])) continue;
      const int x = static_cast<int>(std::lround(places_[v]->u));
      const int y = static_cast<int>(std::lround(places_[v]->v));
      if (pixels_[1].at<std::uint8_t>(y, x) != 0) {
        add(sums[v].inside, image_.at<cv::Vec3b>(y, x));
        ++sums[v].inside_views;
      } else if (const auto color = nearest_inside(image_, pixels_[0], x, y)) {
        add(sums[v].border, *color);
        ++sums[v].border_views;
      }
    }
  }

 private:
  cv::Mat image_;
  std::array<cv::Mat, 2> pixels_;
  DepthMap depths_;
  std::vector<std::optional<DepthMap::Place>> places_;
};

// Vertices without a colour take the mean of their neighbours', in rounds from those that have one.
void spread(const nef::Mesh& mesh, std::vector<std::optional<std::array<double, 3>>>& colors) {
  std::vector<std::array<double, 4>> sums(colors.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (auto& sum : sums) sum = {};
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      for (std::size_t k = 0; k < face.size(); ++k) {
        const std::uint32_t u = face[k];
        const std::uint32_t v = face[k + 1 < face.size() ? k + 1 : 0];
        for (const auto& [from, to] : {std::array{u, v}, std::array{v, u}}) {
          if (!colors[from] || colors[to]) continue;
          for (std::size_t i = 0; i < 3; ++i) sums[to][i] += (*colors[from])[i];
          sums[to][3] += 1;
        }
      }
    }
    for (std::size_t v = 0; v < colors.size(); ++v) {
      if (colors[v] || sums[v][3] == 0) continue;
      colors[v] = {sums[v][0] / sums[v][3], sums[v][1] / sums[v][3], sums[v][2] / sums[v][3]};
      changed = true;
    }
  }
}

}  // namespace

std::filesystem::path photograph_of(const std::filesystem::path& image) {
  const std::filesystem::path folder = image.parent_path();
  if (folder.filename() != "masks" && folder.filename() != "silhouettes") return image;
  const std::filesystem::path above = folder.parent_path();
  return look_up_image({above / "images", above}, image.stem().string()).value_or(image);
}

VertexColors vertex_colors(const nef::Mesh& mesh, const std::vector<ViewResult>& views, PixelOrigin origin,
                           const nef::Monitor& monitor) {
  std::vector<const ViewResult*> seeing;
  for (const ViewResult& view : views) {
    if (!view.image.empty()) seeing.push_back(&view);
  }
  if (seeing.empty()) throw nef::InputError("--color needs images; the views are polygons");
  Points points;
  for (const nef::Rational3& p : mesh.vertices) {
    points.push_back({nef::nearest_double(p[0]), nef::nearest_double(p[1]), nef::nearest_double(p[2])});
  }
  // Colours are whole numbers, so their sums do not depend on the order of the views.
  std::vector<Sum> sums(points.size());
  std::mutex summing;
  nef::parallel_for(seeing.size(), monitor, [&](std::size_t i, const nef::Monitor&) {
    const ViewColors view(*seeing[i], origin, mesh, points);
    const std::lock_guard<std::mutex> lock(summing);
    view.add_to(sums);
  });
  VertexColors result;
  std::vector<std::optional<std::array<double, 3>>> means(points.size());
  for (std::size_t v = 0; v < means.size(); ++v) {
    const bool inside = sums[v].inside_views > 0;
    const std::uint32_t count = inside ? sums[v].inside_views : sums[v].border_views;
    if (count == 0) {
      ++result.unseen;
      continue;
    }
    means[v] = inside ? sums[v].inside : sums[v].border;
    for (double& channel : *means[v]) channel /= count;
  }
  spread(mesh, means);
  constexpr std::array<double, 3> kGray{128, 128, 128};
  for (const auto& mean : means) {
    const std::array<double, 3> color = mean.value_or(kGray);
    result.colors.push_back({static_cast<std::uint8_t>(std::lround(color[0])),
                             static_cast<std::uint8_t>(std::lround(color[1])),
                             static_cast<std::uint8_t>(std::lround(color[2]))});
  }
  return result;
}

}  // namespace nef::visual_hull

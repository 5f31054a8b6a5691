// SPDX-License-Identifier: Apache-2.0
//
// For each view: draw the mesh into a depth map, look up the pixel of each point that the view sees, and add its
// colour to the sums of the point. Views are processed in parallel; colours are whole numbers, so the order of the
// sums does not matter. Vertices without a colour take the mean of their neighbours in rounds, breadth first.
#include "apps/visual_hull/color/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

/// Sums of colours: of views that see a point well inside of their silhouette, and of those that see it at its border.
struct Sum {
  std::array<double, 3> inside{};
  std::array<double, 3> border{};
  std::uint32_t inside_views = 0;
  std::uint32_t border_views = 0;

  void add(const PhotoView::Sample& sample) {
    std::array<double, 3>& sum = sample.inside ? inside : border;
    for (std::size_t i = 0; i < 3; ++i) sum[i] += sample.color[i];
    ++(sample.inside ? inside_views : border_views);
  }

  [[nodiscard]] std::optional<std::array<double, 3>> mean() const {
    const std::uint32_t count = inside_views > 0 ? inside_views : border_views;
    if (count == 0) return std::nullopt;
    std::array<double, 3> result = inside_views > 0 ? inside : border;
    for (double& channel : result) channel /= count;
    return result;
  }
};

}  // namespace

FoundColors surface_colors(const nef::Mesh& mesh, const std::vector<std::array<double, 3>>& points,
                           const std::vector<ViewResult>& views, PixelOrigin origin, const std::string& option,
                           const nef::Monitor& monitor) {
  const std::vector<const ViewResult*> seeing = views_with_images(views, option);
  const std::vector<std::array<double, 3>> corners = rounded_points(mesh);
  // Colours are whole numbers, so their sums do not depend on the order of the views.
  std::vector<Sum> sums(points.size());
  std::mutex summing;
  nef::parallel_for(seeing.size(), monitor, [&](std::size_t i, const nef::Monitor&) {
    const PhotoView view(*seeing[i], origin, mesh, corners, option);
    const std::lock_guard<std::mutex> lock(summing);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto place = view.project(points[p]);
      if (!place || !view.sees(*place)) continue;
      if (const auto sample = view.pixel_at(*place)) sums[p].add(*sample);
    }
  });
  FoundColors means;
  means.reserve(sums.size());
  for (const Sum& sum : sums) means.push_back(sum.mean());
  return means;
}

void spread_colors(const nef::Mesh& mesh, FoundColors& colors) {
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

Color rounded_color(const std::optional<std::array<double, 3>>& color) {
  constexpr std::array<double, 3> kGray{128, 128, 128};
  Color result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = static_cast<std::uint8_t>(std::lround(std::clamp((color ? *color : kGray)[i], 0.0, 255.0)));
  }
  return result;
}

VertexColors vertex_colors(const nef::Mesh& mesh, const std::vector<ViewResult>& views, PixelOrigin origin,
                           const nef::Monitor& monitor) {
  FoundColors means = surface_colors(mesh, rounded_points(mesh), views, origin, "--color", monitor);
  VertexColors result;
  result.unseen = static_cast<std::size_t>(std::count(means.begin(), means.end(), std::nullopt));
  spread_colors(mesh, means);
  for (const auto& mean : means) result.colors.push_back(rounded_color(mean));
  return result;
}

}  // namespace nef::visual_hull

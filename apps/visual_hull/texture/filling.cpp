// SPDX-License-Identifier: Apache-2.0
//
// Holes of charts: breadth first from their borders, a layer of texels at a time. Charts without any colour: colours of
// vertices, spread over the mesh, and interpolated. Gaps: the label of the nearest texel in a distance transform.
#include "apps/visual_hull/texture/filling.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "apps/visual_hull/color/vertex_colors.h"

namespace nef::visual_hull {
namespace {

/// Fills holes of charts in layers from their borders: a texel gets the mean of the neighbours that have colours.
class HoleFilling {
 public:
  HoleFilling(const Atlas& atlas, Texels& texels) : atlas_(atlas), texels_(texels), known_(texels.size(), 0) {}

  /// Fills what it can; returns for each texel whether it has a colour.
  std::vector<std::uint8_t> run() {
    std::vector<std::size_t> layer;
    for (std::size_t texel = 0; texel < texels_.size(); ++texel) {
      if (texels_.grade[texel] != TexelGrade::kNone) known_[texel] = kDone;
    }
    for (std::size_t texel = 0; texel < texels_.size(); ++texel) {
      if (known_[texel] == kDone) add_neighbours(texel, layer);
    }
    while (!layer.empty()) {
      std::vector<std::array<float, 3>> colors;
      for (const std::size_t texel : layer) colors.push_back(mean_around(texel));
      for (std::size_t i = 0; i < layer.size(); ++i) {
        texels_.color[layer[i]] = colors[i];
        known_[layer[i]] = kDone;
      }
      std::vector<std::size_t> next;
      for (const std::size_t texel : layer) add_neighbours(texel, next);
      layer = std::move(next);
    }
    return std::move(known_);
  }

 private:
  static constexpr std::uint8_t kWaiting = 1;
  static constexpr std::uint8_t kDone = 2;

  template <typename Visit>
  void for_neighbours(std::size_t texel, Visit&& visit) const {
    const int x = texels_.x_of(texel);
    const int y = texels_.y_of(texel);
    const std::uint32_t chart = chart_of(texel);
    for (const auto& [dx, dy] : {std::array{-1, 0}, std::array{1, 0}, std::array{0, -1}, std::array{0, 1}}) {
      if (x + dx < 0 || y + dy < 0 || x + dx >= texels_.width() || y + dy >= texels_.height()) continue;
      const std::size_t other = texels_.index(x + dx, y + dy);
      if (texels_.triangle(other) != Texels::kFree && chart_of(other) == chart) visit(other);
    }
  }

  [[nodiscard]] std::uint32_t chart_of(std::size_t texel) const { return atlas_.chart_of[texels_.triangle(texel)]; }

  void add_neighbours(std::size_t texel, std::vector<std::size_t>& layer) {
    for_neighbours(texel, [&](std::size_t other) {
      if (known_[other] != 0) return;
      known_[other] = kWaiting;
      layer.push_back(other);
    });
  }

  [[nodiscard]] std::array<float, 3> mean_around(std::size_t texel) const {
    std::array<float, 3> sum{};
    float count = 0;
    for_neighbours(texel, [&](std::size_t other) {
      if (known_[other] != kDone) return;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += texels_.color[other][c];
      count += 1;
    });
    for (float& channel : sum) channel /= count;  // at least one
    return sum;
  }

  const Atlas& atlas_;
  Texels& texels_;
  std::vector<std::uint8_t> known_;
};

// The mean colour of each vertex in the charts where it has one, spread to the others.
FoundColors colors_of_vertices(const nef::Mesh& mesh, const Surface& surface, const Atlas& atlas, const Texels& texels,
                               const std::vector<std::uint8_t>& known) {
  std::vector<std::array<double, 4>> sums(mesh.vertices.size());
  for (std::size_t t = 0; t < surface.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t texel = texels.texel_at(atlas.places[t][i]);
      if (texels.triangle(texel) == Texels::kFree || known[texel] == 0) continue;
      std::array<double, 4>& sum = sums[surface.triangle(t)[i]];
      for (std::size_t c = 0; c < 3; ++c) sum[c] += static_cast<double>(texels.color[texel][c]);
      sum[3] += 1;
    }
  }
  FoundColors colors(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    if (sums[v][3] > 0) colors[v] = {sums[v][0] / sums[v][3], sums[v][1] / sums[v][3], sums[v][2] / sums[v][3]};
  }
  spread_colors(mesh, colors);
  return colors;
}

}  // namespace

void fill_unseen(const nef::Mesh& mesh, const Surface& surface, const Atlas& atlas, Texels& texels) {
  const std::vector<std::uint8_t> known = HoleFilling(atlas, texels).run();
  bool all = true;
  for (std::size_t texel = 0; all && texel < texels.size(); ++texel) {
    all = known[texel] != 0 || texels.triangle(texel) == Texels::kFree;
  }
  if (all) return;
  const FoundColors colors = colors_of_vertices(mesh, surface, atlas, texels, known);
  constexpr std::array<double, 3> kGray{128, 128, 128};
  for (std::size_t texel = 0; texel < texels.size(); ++texel) {
    const std::uint32_t t = texels.triangle(texel);
    if (t == Texels::kFree || known[texel] != 0) continue;
    const Weights w = texels.weights(texel);
    std::array<double, 3> color{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<double, 3> corner = colors[surface.triangle(t)[i]].value_or(kGray);
      for (std::size_t c = 0; c < 3; ++c) color[c] += w[i] * corner[c];
    }
    for (std::size_t c = 0; c < 3; ++c) texels.color[texel][c] = static_cast<float>(color[c]);
  }
}

cv::Mat padded_image(const Texels& texels) {
  cv::Mat image(texels.height(), texels.width(), CV_8UC3, cv::Scalar(128, 128, 128));
  cv::Mat free(image.size(), CV_8U, cv::Scalar(255));
  for (std::size_t texel = 0; texel < texels.size(); ++texel) {
    if (texels.triangle(texel) == Texels::kFree) continue;
    const cv::Point at(texels.x_of(texel), texels.y_of(texel));
    const Color color = rounded_color(std::array<double, 3>{static_cast<double>(texels.color[texel][0]),
                                                            static_cast<double>(texels.color[texel][1]),
                                                            static_cast<double>(texels.color[texel][2])});
    image.at<cv::Vec3b>(at) = {color[2], color[1], color[0]};
    free.at<std::uint8_t>(at) = 0;
  }
  cv::Mat distances;
  cv::Mat labels;
  cv::distanceTransform(free, distances, labels, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<cv::Vec3b> color_of_label(texels.size() + 1, cv::Vec3b(128, 128, 128));
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (free.at<std::uint8_t>(y, x) != 0) continue;
      color_of_label[static_cast<std::size_t>(labels.at<int>(y, x))] = image.at<cv::Vec3b>(y, x);
    }
  }
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image.at<cv::Vec3b>(y, x) = color_of_label[static_cast<std::size_t>(labels.at<int>(y, x))];
    }
  }
  return image;
}

}  // namespace nef::visual_hull

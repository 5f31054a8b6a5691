// SPDX-License-Identifier: Apache-2.0
//
// First pass, view by view: the texels of the charts of that view. Charts are disjoint rectangles, so views can be
// processed in parallel. Second pass, view by view again: the means of all texels; and texels without a good colour
// collect what other views have, and keep the best by grade, then by quality of the triangle, then by number of the
// view.
#include "apps/visual_hull/texture/sampling.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <tuple>

#include "apps/visual_hull/color/photo_view.h"
#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {
namespace {

std::optional<PhotoView::Sample> look_up(const PhotoView& view, const nef::Double3& point) {
  const auto place = view.project(point);
  if (!place || !view.sees(*place)) return std::nullopt;
  return view.blend_at(*place);
}

TexelGrade grade_of(const PhotoView::Sample& sample) {
  return sample.inside ? TexelGrade::kInside : TexelGrade::kBorder;
}

void set(Texels& texels, std::size_t texel, const PhotoView::Sample& sample) {
  for (std::size_t i = 0; i < 3; ++i) texels.color[texel][i] = static_cast<float>(sample.color[i]);
  texels.grade[texel] = grade_of(sample);
}

nef::Double3 point_of(const TextureInput& input, const Texels& texels, std::size_t texel) {
  return point_at(input.surface.corners(texels.triangle(texel)), texels.weights(texel));
}

void sample_own(const TextureInput& input, const Atlas& atlas, std::size_t v, Texels& texels) {
  const PhotoView view(*input.views[v], input.origin, input.mesh, input.surface.points(), "--texture");
  for (const Chart& chart : atlas.charts) {
    if (chart.view != v) continue;
    for (int y = chart.y; y < chart.y + chart.height; ++y) {
      for (int x = chart.x; x < chart.x + chart.width; ++x) {
        const std::size_t texel = texels.index(x, y);
        if (texels.triangle(texel) == Texels::kFree) continue;
        if (const auto sample = look_up(view, point_of(input, texels, texel))) set(texels, texel, *sample);
      }
    }
  }
}

/// The best colour for a texel so far.
struct Candidate {
  PhotoView::Sample sample;
  TexelGrade grade = TexelGrade::kNone;
  float quality = 0;
  std::size_t view = 0;

  [[nodiscard]] bool better_than(const Candidate& other) const {
    return std::tuple(grade, quality, other.view) > std::tuple(other.grade, other.quality, view);
  }
};

std::vector<float> best_qualities(const ViewQualities& qualities, std::size_t triangles) {
  std::vector<float> best(triangles, 0);
  for (std::size_t t = 0; t < triangles; ++t) {
    for (std::size_t v = 0; v < qualities.views(); ++v) best[t] = std::max(best[t], qualities.at(t, v));
  }
  return best;
}

// Qualities have the square of the cosine: of the area in the image, and as a factor of their own.
std::uint32_t weight_of(float quality, float best) {
  return static_cast<std::uint32_t>(
      std::max(1L, std::lround(static_cast<float>(MeanColors::kFullWeight) * std::sqrt(quality / best))));
}

}  // namespace

void MeanColors::add(std::size_t texel, const std::array<double, 3>& color, std::uint32_t weight) {
  std::array<std::uint32_t, 4>& sum = sums_[texel];
  for (std::size_t c = 0; c < 3; ++c) {
    const auto value = static_cast<std::uint32_t>(std::lround(color[c]));
    std::atomic_ref(sum[c]).fetch_add(weight * value, std::memory_order_relaxed);
  }
  std::atomic_ref(sum[3]).fetch_add(weight, std::memory_order_relaxed);
}

std::array<float, 3> MeanColors::mean(std::size_t texel) const {
  const std::array<std::uint32_t, 4>& sum = sums_[texel];
  std::array<float, 3> color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<float>(static_cast<double>(sum[c]) / sum[3]);
  return color;
}

MeanColors sample_views(const TextureInput& input, const Atlas& atlas, const ViewQualities& qualities, Texels& texels,
                        const nef::Monitor& monitor) {
  nef::parallel_for(input.views.size(), monitor,
                    [&](std::size_t v, const nef::Monitor&) { sample_own(input, atlas, v, texels); });
  std::vector<std::size_t> weak;
  for (std::size_t texel = 0; texel < texels.size(); ++texel) {
    if (texels.triangle(texel) != Texels::kFree && texels.grade[texel] != TexelGrade::kInside) weak.push_back(texel);
  }
  const std::vector<float> best_quality = best_qualities(qualities, input.surface.size());
  MeanColors means(texels.size());
  std::vector<Candidate> best(weak.size());
  std::mutex comparing;
  nef::parallel_for(input.views.size(), monitor, [&](std::size_t v, const nef::Monitor&) {
    const PhotoView view(*input.views[v], input.origin, input.mesh, input.surface.points(), "--texture");
    std::vector<std::pair<std::size_t, Candidate>> found;
    std::size_t next = 0;  // of the weak ones
    for (std::size_t texel = 0; texel < texels.size(); ++texel) {
      const bool is_weak = next < weak.size() && weak[next] == texel;
      const std::size_t i = is_weak ? next++ : next;
      const std::uint32_t t = texels.triangle(texel);
      if (t == Texels::kFree) continue;
      const float quality = qualities.at(t, v);
      if (!(quality > 0)) continue;
      const auto sample = look_up(view, point_of(input, texels, texel));
      if (!sample) continue;
      if (sample->inside) means.add(texel, sample->color, weight_of(quality, best_quality[t]));
      if (!is_weak || atlas.charts[atlas.chart_of[t]].view == v) continue;
      found.emplace_back(i, Candidate{*sample, grade_of(*sample), quality, v});
    }
    const std::lock_guard<std::mutex> lock(comparing);
    for (const auto& [i, candidate] : found) {
      if (candidate.better_than(best[i])) best[i] = candidate;
    }
  });
  for (std::size_t i = 0; i < weak.size(); ++i) {
    if (best[i].grade > texels.grade[weak[i]]) set(texels, weak[i], best[i].sample);
  }
  return means;
}

}  // namespace nef::visual_hull

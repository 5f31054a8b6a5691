// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/edge_scene.h"

#include <atomic>

#include "nef/base/threads/parallel.h"

namespace nef::visual_hull {

namespace {

// An exact point takes some microseconds, the general way about half a millisecond for an edge.
constexpr std::size_t kExactPoints = 10000;
constexpr std::size_t kExactPointsOfEdge = 50;

}  // namespace

std::unique_ptr<const EdgeScene> EdgeScene::make(const std::vector<DirectView>& inputs, const WorldBox& box,
                                                 const nef::Monitor& monitor) {
  std::unique_ptr<EdgeScene> scene(new EdgeScene);
  Double3 reach{};
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    scene->low[i] = nef::nearest_double(box.low[i]);
    scene->high[i] = nef::nearest_double(box.high[i]);
    size = std::max(size, scene->high[i] - scene->low[i]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    scene->farthest[i] = std::max(std::abs(scene->low[i]), std::abs(scene->high[i]));
    reach[i] = scene->farthest[i] + size / 100;
  }
  std::vector<std::uint32_t> first(inputs.size());
  std::size_t edge_count = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    first[i] = static_cast<std::uint32_t>(edge_count);
    edge_count += inputs[i].silhouette->vertex_count();
  }
  scene->exact_budget_ = kExactPoints + kExactPointsOfEdge * edge_count;
  scene->edges.resize(edge_count);
  std::vector<std::optional<EdgeView>> views(inputs.size());
  std::atomic<bool> good = true;
  nef::parallel_for(inputs.size(), monitor, [&](std::size_t i, const nef::Monitor&) {
    const DirectView& input = inputs[i];
    const bool in_front = input.camera->is_parallel() || sgn(depth_range(*input.camera, box).nearest) > 0;
    if (good && in_front) {
      auto view = EdgeView::make(*input.camera, *input.silhouette, static_cast<std::uint32_t>(i), first[i], reach,
                                 scene->edges);
      if (view) views[i].emplace(std::move(*view));
    }
    if (!views[i]) good = false;
  });
  if (!good) return nullptr;
  scene->views.reserve(inputs.size());
  for (std::optional<EdgeView>& view : views) scene->views.push_back(std::move(*view));
  return scene;
}

// Cramer's rule by cross products of the normals.
std::optional<ExactPoint> EdgeScene::exact(const SpotName& name) const {
  std::array<std::array<Integer, 4>, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = views[edges[name[i]].view].plane(name[i]);
  ExactPoint x;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = p[(i + 1) % 3];
    const auto& b = p[(i + 2) % 3];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const std::size_t m = (k + 2) % 3;
      const Integer cross = a[l] * b[m] - a[m] * b[l];
      x[k] -= p[i][3] * cross;
      if (i == 0) x[3] += p[0][k] * cross;
    }
  }
  const int sign = sgn(x[3]);
  if (sign == 0) return std::nullopt;
  if (sign < 0) {
    for (Integer& value : x) mpz_neg(value.get_mpz_t(), value.get_mpz_t());
  }
  return x;
}

}  // namespace nef::visual_hull

// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/edge_scene.h"

#include "nef/base/predicate_counts.h"

namespace visual_hull {

namespace {

// As many exact points as edges, and some, are ordinary. Where doubles decide hardly anything, cone by cone is faster.
constexpr std::size_t kExactSpots = 1000;

}  // namespace

std::unique_ptr<const EdgeScene> EdgeScene::make(const std::vector<DirectView>& inputs, const WorldBox& box) {
  std::unique_ptr<EdgeScene> scene(new EdgeScene);
  for (std::size_t i = 0; i < 3; ++i) {
    scene->low[i] = nef::nearest_double(box.low[i]);
    scene->high[i] = nef::nearest_double(box.high[i]);
    scene->size = std::max(scene->size, scene->high[i] - scene->low[i]);
  }
  Vec3 reach{};
  for (std::size_t i = 0; i < 3; ++i) {
    reach[i] = std::max(std::abs(scene->low[i]), std::abs(scene->high[i])) + scene->size / 100;
  }
  std::size_t edge_count = 0;
  for (const DirectView& input : inputs) edge_count += input.silhouette->vertex_count();
  scene->exact_budget_ = kExactSpots + edge_count;
  scene->edges.reserve(edge_count);
  scene->views.reserve(inputs.size());
  for (const DirectView& input : inputs) {
    if (sgn(depth_range(*input.camera, box).nearest) <= 0) return nullptr;
    std::optional<EdgeView> view = EdgeView::make(
        *input.camera, *input.silhouette, static_cast<std::uint32_t>(scene->views.size()), reach, *scene, scene->edges);
    if (!view) return nullptr;
    scene->views.push_back(std::move(*view));
  }
  return scene;
}

std::optional<Rational3> EdgeScene::exact(const Spot& spot) const {
  if (spot.name == kNoName) return std::nullopt;
  // A sum over all threads, so whether it is exceeded does not depend on them.
  if (exact_spots_.fetch_add(1, std::memory_order_relaxed) > exact_budget_) return std::nullopt;
  std::array<RationalPlane, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const ViewingEdge& edge = edges[spot.name[i]];
    p[i] = plane_through(views[edge.view].camera(), *edge.from, *edge.to);
  }
  // Cramer's rule by cross products of the normals.
  const auto product = [](const Rational3& a, const Rational3& b) {
    return Rational3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Rational3 qr = product(p[1].normal, p[2].normal);
  const Rational3 rp = product(p[2].normal, p[0].normal);
  const Rational3 pq = product(p[0].normal, p[1].normal);
  const Rational determinant = p[0].normal[0] * qr[0] + p[0].normal[1] * qr[1] + p[0].normal[2] * qr[2];
  if (sgn(determinant) == 0) return std::nullopt;
  Rational3 x;
  for (std::size_t i = 0; i < 3; ++i) {
    x[i] = -(p[0].offset * qr[i] + p[1].offset * rp[i] + p[2].offset * pq[i]) / determinant;
  }
  return x;
}

double EdgeScene::height(const ViewingEdge& edge, const Vec3& at, double at_error, double& error) const {
  double value = edge.offset;
  double size = std::abs(edge.offset);
  double reach = 0;
  double slope = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    value += edge.normal.at[k] * at[k];
    size += std::abs(edge.normal.at[k] * at[k]);
    reach += std::abs(at[k]) + at_error;
    slope += std::abs(edge.normal.at[k]);
  }
  error = size * kRounding + edge.offset_error + reach * edge.normal.error + slope * at_error * 1.0001;
  return value;
}

bool EdgeScene::refine(Spot& spot) const {
  ++nef::predicate_counts().exact;
  const std::optional<Rational3> x = exact(spot);
  if (!x) return false;
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    spot.at[k] = nef::nearest_double((*x)[k]);
    largest = std::max(largest, std::abs(spot.at[k]));
  }
  spot.error = largest * kRounding;
  return true;
}

double EdgeScene::reach(const Vec3& at) const {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += std::max(std::abs(low[k] - at[k]), std::abs(high[k] - at[k]));
  return sum;
}

}  // namespace visual_hull

// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/direct_hull.h"

#include <atomic>
#include <tuple>

#include "apps/visual_hull/viewing_edges/facet_pairs.h"
#include "apps/visual_hull/viewing_edges/hull_complex.h"
#include "apps/visual_hull/viewing_edges/line_cutter.h"
#include "nef/base/parallel.h"
#include "nef/base/predicate_counts.h"

namespace visual_hull {
namespace {

/// Finds the edges of the hull on pairs of facets and on rays.
class EdgeFinder {
 public:
  EdgeFinder(const EdgeScene& scene, std::vector<SpotName>& found) : s_(scene), cutter_(scene, found) {}

  // Edges on the edges of cones, in which the silhouettes' edges of a range begin. This and what follows: false, or
  // nothing, if something remains undecided.
  [[nodiscard]] bool rays(std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t e = begin; e < end; ++e) {
      if (s_.edges[e].place != e) continue;
      const std::uint32_t i = s_.edges[e].view;
      const EdgeView& view = s_.views[i];
      const Vector& ray = s_.edges[e].ray;
      Spot apex{view.centre().at, view.centre().error, kNoName};
      // A far end beyond the box; the apex is in front of it.
      const double reach = s_.reach(apex.at);
      Spot far = apex;
      const double scale = 2 * reach / norm(ray.at);
      for (std::size_t k = 0; k < 3; ++k) far.at[k] += scale * ray.at[k];
      far.error = apex.error + scale * ray.error + reach * kRounding;
      if (!cutter_.cut({apex, far}, s_.edges[e].previous, e, i, i)) return false;
    }
    return true;
  }

  // Edges in the facets of two edges of different views.
  [[nodiscard]] bool pair(std::uint32_t e, std::uint32_t f) {
    const std::uint32_t i = s_.edges[e].view;
    const std::uint32_t j = s_.edges[f].view;
    const Axis axis = axis_between(i, j);
    const std::array<std::uint32_t, 2> rays{s_.edges[e].place, s_.edges[s_.edges[e].next].place};
    const std::array<std::uint32_t, 2> others{s_.edges[f].place, s_.edges[s_.edges[f].next].place};
    std::array<std::array<int, 2>, 2> sides{};
    for (std::size_t k = 0; k < 2; ++k) {
      for (std::size_t l = 0; l < 2; ++l) {
        const std::optional<int> s = side(axis, i, j, rays[k], others[l]);
        if (!s) return false;
        sides[k][l] = *s;
      }
    }
    spots_.clear();
    for (std::size_t k = 0; k < 2; ++k) {
      if (sides[k][0] != sides[k][1] && !pierce(i, j, rays[k], f)) return false;
      if (sides[0][k] != sides[1][k] && !pierce(j, i, others[k], e)) return false;
    }
    if (spots_.empty()) return true;
    if (spots_.size() > 2) return false;
    const std::optional<Spot> end = spots_.size() == 2 ? spots_[1] : far_end(spots_[0], e, f);
    return end && cutter_.cut({spots_[0], *end}, e, f, i, j);
  }

 private:
  struct Axis {
    Vec3 along{};
    double length = 0;
    double error = 0;
  };

  [[nodiscard]] Axis axis_between(std::uint32_t i, std::uint32_t j) const {
    Axis axis;
    const Vector& a = s_.views[i].centre();
    const Vector& b = s_.views[j].centre();
    for (std::size_t k = 0; k < 3; ++k) axis.along[k] = b.at[k] - a.at[k];
    axis.length = norm(axis.along);
    axis.error = a.error + b.error + axis.length * kRounding;
    return axis;
  }

  // The sign of det(axis, ray of e, ray of g): the side of ray g on which ray e passes.
  std::optional<int> side(const Axis& axis, std::uint32_t i, std::uint32_t j, std::uint32_t e, std::uint32_t g) const {
    const Vector& r = s_.edges[e].ray;
    const Vector& q = s_.edges[g].ray;
    const double nr = s_.edges[e].ray_length;
    const double nq = s_.edges[g].ray_length;
    const double nb = axis.length;
    const double value = dot(axis.along, cross(r.at, q.at));
    // Each factor is off by its error; 16 covers norms of components and the roundings.
    const double bound = 16 * (nb * nr * nq * kRounding + axis.error * nr * nq + nb * (r.error * nq + q.error * nr));
    if (value > bound || value < -bound) {
      ++nef::predicate_counts().filter;
      return value > 0 ? 1 : -1;
    }
    ++nef::predicate_counts().exact;
    const Camera& a = s_.views[i].camera();
    const Camera& b = s_.views[j].camera();
    const Rational3 x = a.ray(*s_.edges[e].from);
    const Rational3 y = b.ray(*s_.edges[g].from);
    Rational determinant;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const std::size_t m = (k + 2) % 3;
      determinant += (b.centre()[k] - a.centre()[k]) * (x[l] * y[m] - x[m] * y[l]);
    }
    if (sgn(determinant) == 0) return std::nullopt;
    return sgn(determinant);
  }

  // Ray e of view i, which passes through the facet of edge f of view j or behind a camera.
  [[nodiscard]] bool pierce(std::uint32_t i, std::uint32_t j, std::uint32_t e, std::uint32_t f) {
    Spot spot;
    const std::optional<bool> in_front = pierce(i, j, e, f, spot);
    if (in_front && *in_front) spots_.push_back(spot);
    return in_front.has_value();
  }

  // Where the line of ray e meets the plane of edge f; true if in front of both cameras.
  std::optional<bool> pierce(std::uint32_t i, std::uint32_t j, std::uint32_t e, std::uint32_t f, Spot& spot) const {
    const ViewingEdge& edge = s_.edges[f];
    const Vector& ray = s_.edges[e].ray;
    const Vector& centre = s_.views[i].centre();
    spot.name = sorted_name(s_.edges[e].previous, e, f);
    double height_error = 0;
    const double height = s_.height(edge, centre.at, centre.error, height_error);
    const double slope = dot(edge.normal.at, ray.at);
    const double slope_error =
        4 * (norm(edge.normal.at) * (ray.error + norm(ray.at) * kRounding) + edge.normal.error * norm(ray.at));
    const double t = -height / slope;
    const double t_error =
        (height_error + std::abs(t) * slope_error) / (std::abs(slope) - slope_error) * 1.0001 + std::abs(t) * kRounding;
    const bool sure = std::abs(slope) > 2 * slope_error;
    if (sure && t < -t_error) return false;
    if (sure && t > t_error) {
      double largest = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        spot.at[k] = centre.at[k] + t * ray.at[k];
        largest = std::max({largest, std::abs(centre.at[k]), std::abs(t * ray.at[k])});
      }
      spot.error = norm(ray.at) * t_error + t * ray.error + centre.error + largest * kRounding;
      double depth_error = 0;
      const double depth = s_.views[j].depth(spot, depth_error);
      if (depth < -depth_error) return false;
      if (depth > depth_error) return true;
    }
    const std::optional<Rational3> exact = s_.exact(spot);
    if (!exact) return std::nullopt;
    const int own = sgn(s_.views[i].camera().depth(*exact));
    const int other = sgn(s_.views[j].camera().depth(*exact));
    if (own == 0 || other == 0) return std::nullopt;
    if (own < 0 || other < 0) return false;
    if (!s_.refine(spot)) return std::nullopt;
    return true;
  }

  // A point far out on the line of two edges' planes, in front of both cameras.
  std::optional<Spot> far_end(const Spot& a, std::uint32_t e, std::uint32_t f) const {
    const ViewingEdge& p = s_.edges[e];
    const ViewingEdge& q = s_.edges[f];
    Vec3 direction = cross(p.normal.at, q.normal.at);
    const double length = norm(direction);
    const double np = norm(p.normal.at);
    const double nq = norm(q.normal.at);
    const double error = 8 * (np * q.normal.error + nq * p.normal.error + np * nq * kRounding);
    if (!(length > 4 * error)) return std::nullopt;
    const auto deeper = [&](std::uint32_t view) -> std::optional<bool> {
      const auto& m = s_.views[view].depth_row();
      const Vec3 row{m[0], m[1], m[2]};
      const double value = dot(row, direction);
      if (!(std::abs(value) > 4 * norm(row) * (error + length * kRounding))) return std::nullopt;
      return value > 0;
    };
    const std::optional<bool> forward = deeper(p.view);
    if (!forward || forward != deeper(q.view)) return std::nullopt;
    const double reach = s_.reach(a.at);
    const double scale = (*forward ? 2 : -2) * reach / length;
    Spot far;
    for (std::size_t k = 0; k < 3; ++k) far.at[k] = a.at[k] + scale * direction[k];
    far.error = a.error + std::abs(scale) * error + (reach + norm(a.at)) * kRounding;
    return far;
  }

  const EdgeScene& s_;
  LineCutter cutter_;
  std::vector<Spot> spots_;
};

// (Nearly) one centre: not for the direct way.
bool centres_apart(const EdgeScene& scene) {
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Vector& a = scene.views[i].centre();
      const Vector& b = scene.views[j].centre();
      const double distance = norm({b.at[0] - a.at[0], b.at[1] - a.at[1], b.at[2] - a.at[2]});
      if (!(distance > (a.error + b.error + distance * kRounding) * 1e6)) return false;
    }
  }
  return true;
}

// The names of all vertices, once for each edge that ends there; nothing if one remains undecided.
std::optional<std::vector<SpotName>> vertex_names(const EdgeScene& scene, unsigned threads) {
  constexpr std::size_t kRays = 64;  // a task; what is found does not depend on these, nor on the threads
  constexpr std::size_t kPairs = 4096;
  const FacetPairs pairs = facet_pairs(scene, threads);
  const std::size_t ray_tasks = (scene.edges.size() + kRays - 1) / kRays;
  const std::size_t tasks = ray_tasks + (pairs.size() + kPairs - 1) / kPairs;
  std::vector<std::vector<SpotName>> found(tasks);
  std::atomic<bool> decided = true;
  nef::parallel_for(tasks, threads, [&](std::size_t k) {
    if (!decided.load(std::memory_order_relaxed)) return;
    EdgeFinder finder(scene, found[k]);
    bool good = true;
    if (k < ray_tasks) {
      good = finder.rays(static_cast<std::uint32_t>(k * kRays),
                         static_cast<std::uint32_t>(std::min((k + 1) * kRays, scene.edges.size())));
    } else {
      const std::size_t first = (k - ray_tasks) * kPairs;
      for (std::size_t p = first; good && p < std::min(first + kPairs, pairs.size()); ++p) {
        good = finder.pair(pairs[p][0], pairs[p][1]);
      }
    }
    if (!good) decided.store(false, std::memory_order_relaxed);
  });
  if (!decided) return std::nullopt;
  std::vector<SpotName> names;
  for (const auto& part : found) names.insert(names.end(), part.begin(), part.end());
  return names;
}

// How many edges of the hull end in a vertex: one on a ray and two in the facets of each corner there, or three.
std::size_t edges_at(const SpotName& name, const std::vector<ViewingEdge>& edges) {
  const std::optional<std::uint32_t> corner = corner_of(name, edges);
  if (!corner) return 3;
  std::size_t count = 1;
  for (std::uint32_t at = *corner; at != UINT32_MAX; at = edges[at].next_at_place) count += 2;
  return count;
}

}  // namespace

std::optional<nef::Polyhedron> direct_hull(const std::vector<DirectView>& views, const WorldBox& box,
                                           unsigned threads) {
  if (views.size() < 3) return std::nullopt;
  const std::unique_ptr<const EdgeScene> scene = EdgeScene::make(views, box);
  if (!scene || !centres_apart(*scene)) return std::nullopt;
  std::optional<std::vector<SpotName>> names = vertex_names(*scene, threads);
  if (!names) return std::nullopt;
  std::sort(names->begin(), names->end());
  std::vector<SpotName> vertices;
  for (auto name = names->begin(); name != names->end();) {
    const auto end = std::find_if(name, names->end(), [&](const SpotName& other) { return other != *name; });
    if (static_cast<std::size_t>(end - name) != edges_at(*name, scene->edges)) return std::nullopt;
    vertices.push_back(*name);
    name = end;
  }
  std::vector<const Camera*> cameras;
  for (const DirectView& input : views) cameras.push_back(input.camera);
  return complex_of(vertices, scene->edges, cameras);
}

}  // namespace visual_hull

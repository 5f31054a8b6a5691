// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/direct_hull.h"

#include <atomic>
#include <tuple>

#include "apps/visual_hull/viewing_edges/hull_complex.h"
#include "apps/visual_hull/viewing_edges/line_cutter.h"
#include "nef/base/parallel.h"
#include "nef/base/predicate_counts.h"

namespace visual_hull {
namespace {

/// Finds the edges of the hull on one pair of views, or on the rays of one.
class EdgeFinder {
 public:
  EdgeFinder(const EdgeScene& scene, std::vector<SpotName>& found) : s_(scene), cutter_(scene, found) {}

  // Edges on the edges of view i's cone. This and what follows: false, or nothing, if something remains undecided.
  [[nodiscard]] bool rays(std::uint32_t i) {
    const EdgeView& view = s_.views[i];
    for (std::uint32_t e = view.first_edge(); e < view.first_edge() + view.edge_count(); ++e) {
      if (s_.edges[e].place != e) continue;
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

  // Edges in a facet of each of two cones.
  [[nodiscard]] bool pairs(std::uint32_t i, std::uint32_t j) {
    meetings_.clear();
    spots_.clear();
    if (!sweep(i, j) || !sweep(j, i)) return false;
    std::sort(meetings_.begin(), meetings_.end());
    for (std::size_t k = 0; k < meetings_.size();) {
      std::size_t end = k + 1;
      while (end < meetings_.size() && meetings_[end].edges == meetings_[k].edges) ++end;
      const auto [e, f] = meetings_[k].edges;
      const Spot& a = spots_[meetings_[k].spot];
      if (end - k > 2) return false;
      const std::optional<Spot> b = end - k == 2 ? spots_[meetings_[k + 1].spot] : far_end(a, e, f);
      if (!b || !cutter_.cut({a, *b}, e, f, i, j)) return false;
      k = end;
    }
    return true;
  }

 private:
  /// A place where the facets of two edges (of the first view and the second) begin or end to meet.
  struct Meeting {
    std::array<std::uint32_t, 2> edges{};
    std::uint32_t spot = 0;
    bool operator<(const Meeting& o) const { return std::tie(edges, spot) < std::tie(o.edges, o.spot); }
  };

  /// A ray as seen along the line through the two centres.
  struct Turn {
    double angle = 0;
    std::uint32_t edge = 0;
    bool operator<(const Turn& o) const { return angle < o.angle; }
  };

  struct Axis {
    Vec3 along{}, u{}, w{};
    double error = 0;
  };

  std::optional<Axis> axis_between(std::uint32_t i, std::uint32_t j) const {
    Axis axis;
    const Vector& a = s_.views[i].centre();
    const Vector& b = s_.views[j].centre();
    for (std::size_t k = 0; k < 3; ++k) axis.along[k] = b.at[k] - a.at[k];
    const double length = norm(axis.along);
    axis.error = a.error + b.error + length * kRounding;
    // (Nearly) one centre. The factor is a choice: with it angles below are good to about a millionth, and what they
    // miss is noticed (see kSlack).
    if (!(length > axis.error * 1e6)) return std::nullopt;
    std::size_t least = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (std::abs(axis.along[k]) < std::abs(axis.along[least])) least = k;
    }
    Vec3 unit{};
    unit[least] = 1;
    axis.u = cross(axis.along, unit);
    const double scale = norm(axis.u);
    for (double& c : axis.u) c /= scale;
    axis.w = cross(axis.along, axis.u);
    for (double& c : axis.w) c /= length;
    return axis;
  }

  // The angle of a ray around the axis; NaN if it runs nearly along the axis: such rays are tried with all facets.
  static double angle_of(const Axis& axis, const Vec3& ray) {
    const double x = dot(ray, axis.u);
    const double y = dot(ray, axis.w);
    return std::hypot(x, y) > 1e-6 * norm(ray) ? std::atan2(y, x) : NAN;
  }

  // Where the rays of view i meet the facets of view j.
  [[nodiscard]] bool sweep(std::uint32_t i, std::uint32_t j) {
    const std::optional<Axis> between = axis_between(i, j);
    if (!between) return false;
    const Axis& axis = *between;
    const EdgeView& from = s_.views[i];
    const EdgeView& to = s_.views[j];
    turns_.clear();
    std::vector<std::uint32_t> polar;
    for (std::uint32_t e = from.first_edge(); e < from.first_edge() + from.edge_count(); ++e) {
      if (s_.edges[e].place != e) continue;
      const double angle = angle_of(axis, s_.edges[e].ray.at);
      if (std::isnan(angle)) {
        polar.push_back(e);
      } else {
        turns_.push_back({angle, e});
      }
    }
    std::sort(turns_.begin(), turns_.end());
    for (std::uint32_t f = to.first_edge(); f < to.first_edge() + to.edge_count(); ++f) {
      const double a = angle_of(axis, s_.edges[f].ray.at);
      const double b = angle_of(axis, s_.edges[s_.edges[f].next].ray.at);
      const double turn = std::remainder(b - a, 2 * M_PI);
      // A choice, far above the roundings of angles: it only adds candidates, each of which `meet` decides exactly. A
      // candidate that is missed all the same leaves a vertex without one of its edges, which direct_hull counts.
      constexpr double kSlack = 1e-7;
      if (!(std::abs(turn) < 3)) {  // also for NaN: all rays
        for (const Turn& t : turns_) {
          if (!meet(axis, i, j, t.edge, f)) return false;
        }
      } else {
        const double low = std::min(a, a + turn) - kSlack;
        const double high = std::max(a, a + turn) + kSlack;
        for (const double shift : {-2 * M_PI, 0.0, 2 * M_PI}) {
          auto it = std::lower_bound(turns_.begin(), turns_.end(), Turn{low + shift, 0});
          for (; it != turns_.end() && it->angle <= high + shift; ++it) {
            if (!meet(axis, i, j, it->edge, f)) return false;
          }
        }
      }
      for (const std::uint32_t e : polar) {
        if (!meet(axis, i, j, e, f)) return false;
      }
    }
    return true;
  }

  // The sign of det(axis, ray of e, ray of g): the side of ray g on which ray e passes.
  std::optional<int> side(const Axis& axis, std::uint32_t i, std::uint32_t j, std::uint32_t e, std::uint32_t g) const {
    const Vector& r = s_.edges[e].ray;
    const Vector& q = s_.edges[g].ray;
    const double nr = norm(r.at);
    const double nq = norm(q.at);
    const double nb = norm(axis.along);
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

  // Ray e of view i and the facet of edge f of view j.
  [[nodiscard]] bool meet(const Axis& axis, std::uint32_t i, std::uint32_t j, std::uint32_t e, std::uint32_t f) {
    const std::optional<int> from_side = side(axis, i, j, e, f);
    const std::optional<int> to_side = side(axis, i, j, e, s_.edges[f].next);
    if (!from_side || !to_side) return false;
    if (*from_side == *to_side) return true;
    Spot spot;
    const std::optional<bool> in_front = pierce(i, j, e, f, spot);
    if (!in_front || !*in_front) return in_front.has_value();
    const auto index = static_cast<std::uint32_t>(spots_.size());
    spots_.push_back(spot);
    for (std::uint32_t at = e; at != UINT32_MAX; at = s_.edges[at].next_at_place) {
      for (const std::uint32_t own : {s_.edges[at].previous, at}) {
        meetings_.push_back({i < j ? std::array{own, f} : std::array{f, own}, index});
      }
    }
    return true;
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
  std::vector<Meeting> meetings_;
  std::vector<Spot> spots_;
  std::vector<Turn> turns_;
};

// The names of all vertices, once for each edge that ends there; nothing if one remains undecided.
std::optional<std::vector<SpotName>> vertex_names(const EdgeScene& scene, unsigned threads) {
  const auto n = static_cast<std::uint32_t>(scene.views.size());
  std::vector<std::array<std::uint32_t, 2>> tasks;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = i; j < n; ++j) tasks.push_back({i, j});
  }
  std::vector<std::vector<SpotName>> found(tasks.size());
  std::atomic<bool> decided = true;
  nef::parallel_for(tasks.size(), threads, [&](std::size_t k) {
    if (!decided.load(std::memory_order_relaxed)) return;
    EdgeFinder finder(scene, found[k]);
    const auto [i, j] = tasks[k];
    if (!(i == j ? finder.rays(i) : finder.pairs(i, j))) decided.store(false, std::memory_order_relaxed);
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
  if (!scene) return std::nullopt;
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

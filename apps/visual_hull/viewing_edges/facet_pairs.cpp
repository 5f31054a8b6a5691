// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/viewing_edges/facet_pairs.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "nef/base/parallel.h"

namespace visual_hull {
namespace {

// Choices between the time of one more halving and that of the pairs that it saves.
constexpr std::size_t kFewFacets = 16;
constexpr unsigned kDeepest = 30;  // halvings: ten along each axis
constexpr unsigned kTaskDepth = 7;
constexpr unsigned kLook = 3;  // every third time

// Far above the roundings of the sums below, far below the size of a part.
constexpr double kSlack = 1e-10;

/// What is asked of an edge, close together.
struct Facet {
  std::array<double, 2> low{}, high{};  // of the edge in its image
  Vec3 normal{};
  double offset = 0;
  double error = 0;  // of the height of a point in the box
};

struct Part {
  Vec3 middle{};
  Vec3 half{};
};

/// The edges that a view shows in a part: a range of a list.
struct Shown {
  std::uint32_t view = 0;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// A part that is still to be halved.
struct Task {
  Part part;
  std::vector<Shown> views;
  std::vector<std::uint32_t> edges;
  unsigned depth = 0;
};

class Halving {
 public:
  Halving(const EdgeScene& scene, const std::vector<Facet>& facets) : s_(scene), facets_(facets) {}

  /// Halves until `deepest`; parts that have come so far go to `rest`, or, without it, give their pairs.
  void run(Task task, unsigned deepest, std::vector<Task>* rest) {
    deepest_ = deepest;
    rest_ = rest;
    views_ = std::move(task.views);
    edges_ = std::move(task.edges);
    descend(task.part, 0, 0, task.depth);
  }

  FacetPairs pairs;

 private:
  // The views from `first` on and the edges from `first_edge` on are those of the part.
  void descend(const Part& part, std::size_t first, std::size_t first_edge, unsigned depth) {
    const std::size_t views_end = views_.size();
    const std::size_t edges_end = edges_.size();
    if (views_end - first < 2) return;
    if (edges_end - first_edge <= kFewFacets || depth == deepest_) return give(part, first, first_edge, depth);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (part.half[k] > part.half[axis]) axis = k;
    }
    Part half = part;
    half.half[axis] /= 2;
    for (const double side : {-1.0, 1.0}) {
      half.middle[axis] = part.middle[axis] + side * half.half[axis];
      if (narrow(half, first, views_end, depth + 1)) descend(half, views_end, edges_end, depth + 1);
      views_.resize(views_end);
      edges_.resize(edges_end);
    }
  }

  // Appends what the views show in a part; false if one of them shows nothing of the hull. Planes are asked first:
  // where some pass, what the window tells from parent to child is little.
  bool narrow(const Part& part, std::size_t first, std::size_t end, unsigned depth) {
    const bool look = depth % kLook == 0;
    for (std::size_t k = first; k < end; ++k) {
      const Shown shown = views_[k];
      const auto begin = static_cast<std::uint32_t>(edges_.size());
      for (std::uint32_t i = shown.begin; i < shown.end; ++i) {
        if (passes(facets_[edges_[i]], part)) edges_.push_back(edges_[i]);
      }
      if (look || edges_.size() == begin) {
        const EdgeView& view = s_.views[shown.view];
        const std::optional<EdgeView::Window> window = view.window(part.middle, part.half);
        if (window) {
          edges_.erase(std::remove_if(edges_.begin() + begin, edges_.end(),
                                      [&](std::uint32_t e) { return beside(facets_[e], *window); }),
                       edges_.end());
          if (edges_.size() == begin && view.inside(EdgeView::middle_of(*window)) == false) {
            std::swap(views_[k], views_[first]);  // it may reject the neighbour, too
            return false;
          }
        }
      }
      if (edges_.size() > begin) views_.push_back({shown.view, begin, static_cast<std::uint32_t>(edges_.size())});
    }
    return true;
  }

  static bool passes(const Facet& facet, const Part& part) {
    const Vec3& n = facet.normal;
    const double height = facet.offset + n[0] * part.middle[0] + n[1] * part.middle[1] + n[2] * part.middle[2];
    const double reach =
        facet.error + std::abs(n[0]) * part.half[0] + std::abs(n[1]) * part.half[1] + std::abs(n[2]) * part.half[2];
    return std::abs(height) <= reach;
  }

  static bool beside(const Facet& facet, const EdgeView::Window& window) {
    for (std::size_t k = 0; k < 2; ++k) {
      if (facet.low[k] > window.middle[k] + window.half[k]) return true;
      if (facet.high[k] < window.middle[k] - window.half[k]) return true;
    }
    return false;
  }

  void give(const Part& part, std::size_t first, std::size_t first_edge, unsigned depth) {
    if (rest_ != nullptr && depth == deepest_) {
      rest_->push_back({part,
                        {views_.begin() + static_cast<std::ptrdiff_t>(first), views_.end()},
                        {edges_.begin() + static_cast<std::ptrdiff_t>(first_edge), edges_.end()},
                        depth});
      for (Shown& shown : rest_->back().views) {
        shown.begin -= static_cast<std::uint32_t>(first_edge);
        shown.end -= static_cast<std::uint32_t>(first_edge);
      }
      return;
    }
    for (std::size_t k = first; k < views_.size(); ++k) {
      for (std::size_t l = k + 1; l < views_.size(); ++l) {
        for (std::uint32_t i = views_[k].begin; i < views_[k].end; ++i) {
          for (std::uint32_t j = views_[l].begin; j < views_[l].end; ++j) {
            pairs.push_back({std::min(edges_[i], edges_[j]), std::max(edges_[i], edges_[j])});
          }
        }
      }
    }
  }

  const EdgeScene& s_;
  const std::vector<Facet>& facets_;
  std::vector<Shown> views_;
  std::vector<std::uint32_t> edges_;
  unsigned deepest_ = 0;
  std::vector<Task>* rest_ = nullptr;
};

std::vector<Facet> facets_of(const EdgeScene& scene) {
  std::vector<Facet> facets;
  facets.reserve(scene.edges.size());
  Vec3 farthest{};
  for (std::size_t k = 0; k < 3; ++k) farthest[k] = std::max(std::abs(scene.low[k]), std::abs(scene.high[k]));
  for (const ViewingEdge& edge : scene.edges) {
    Facet facet;
    const auto& a = edge.from->approximate;
    const auto& b = edge.to->approximate;
    for (std::size_t k = 0; k < 2; ++k) {
      facet.low[k] = std::min(a[k], b[k]);
      facet.high[k] = std::max(a[k], b[k]);
    }
    facet.normal = edge.normal.at;
    facet.offset = edge.offset;
    double size = std::abs(edge.offset);
    double reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      size += std::abs(edge.normal.at[k]) * farthest[k];
      reach += farthest[k];
    }
    facet.error = size * kSlack + edge.offset_error + reach * edge.normal.error;
    facets.push_back(facet);
  }
  return facets;
}

// By counting: a pair was met in every part that both facets pass.
FacetPairs once_each(const std::vector<FacetPairs>& found, std::size_t edges) {
  std::vector<std::size_t> begin(edges + 1, 0);
  for (const FacetPairs& part : found) {
    for (const auto& pair : part) ++begin[pair[0] + 1];
  }
  for (std::size_t e = 0; e < edges; ++e) begin[e + 1] += begin[e];
  std::vector<std::uint32_t> others(begin[edges]);
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (const FacetPairs& part : found) {
    for (const auto& pair : part) others[next[pair[0]]++] = pair[1];
  }
  FacetPairs pairs;
  std::vector<std::uint32_t> seen(edges, UINT32_MAX);
  for (std::uint32_t e = 0; e < edges; ++e) {
    for (std::size_t i = begin[e]; i < begin[e + 1]; ++i) {
      if (seen[others[i]] == e) continue;
      seen[others[i]] = e;
      pairs.push_back({e, others[i]});
    }
  }
  return pairs;
}

}  // namespace

FacetPairs facet_pairs(const EdgeScene& scene, unsigned threads) {
  const std::vector<Facet> facets = facets_of(scene);
  Task all;
  for (std::size_t k = 0; k < 3; ++k) {
    all.part.middle[k] = (scene.low[k] + scene.high[k]) / 2;
    all.part.half[k] = (scene.high[k] - scene.low[k]) / 2 * (1 + kSlack);
  }
  for (std::uint32_t v = 0; v < scene.views.size(); ++v) {
    const EdgeView& view = scene.views[v];
    all.views.push_back({v, view.first_edge(), view.first_edge() + view.edge_count()});
  }
  for (std::uint32_t e = 0; e < scene.edges.size(); ++e) all.edges.push_back(e);
  std::vector<Task> tasks;
  Halving above(scene, facets);
  above.run(std::move(all), kTaskDepth, &tasks);
  std::vector<FacetPairs> found(tasks.size() + 1);
  found.back() = std::move(above.pairs);
  nef::parallel_for(tasks.size(), threads, [&](std::size_t k) {
    Halving halving(scene, facets);
    halving.run(std::move(tasks[k]), kDeepest, nullptr);
    found[k] = once_each({std::move(halving.pairs)}, scene.edges.size());
  });
  return once_each(found, scene.edges.size());
}

}  // namespace visual_hull

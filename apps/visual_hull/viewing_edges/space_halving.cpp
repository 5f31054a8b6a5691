// SPDX-License-Identifier: Apache-2.0
//
// Doubles with slack far above their roundings, so that no edge is missed. Where a part shows no edge of a view, the
// view is asked at the part's middle, exactly if need be. Near the surface many views are tangent to the hull, one
// hardly in front of the other: where one of them leaves a half-space of the part (PartCut), others of which nothing
// passes that need not be told apart there.
#include "apps/visual_hull/viewing_edges/space_halving.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "apps/visual_hull/viewing_edges/part_cut.h"
#include "apps/visual_hull/viewing_edges/part_vertices.h"
#include "nef/base/threads/parallel.h"
#include "nef/base/threads/shared_out.h"

namespace nef::visual_hull {
namespace {

// Choices between the time of one more halving and that of the triples that it saves.
constexpr std::size_t kFewFacets = 12;
constexpr unsigned kDeepest = 45;                           // halvings: fifteen along each axis
constexpr std::array<unsigned, 3> kStages{3, 7, kDeepest};  // halvings after which parts go to other threads

/// What the views show in a part.
struct Content {
  std::vector<Shown> views;  // ranges of the edges
  std::vector<std::uint32_t> edges;
  std::size_t count = 0;  // of the edges; behind them is room

  std::span<const std::uint32_t> all_edges() const { return {edges.data(), count}; }
};

/// A part that is still to be halved.
struct Task {
  PartBox box;
  Content content;
  unsigned depth = 0;
};

class Halving {
 public:
  Halving(const EdgeScene& scene, const std::vector<PartFacet>& facets, const nef::Monitor& monitor)
      : s_(scene), facets_(facets), monitor_(monitor), vertices_(scene, monitor) {}

  /// Halves until `deepest`; parts that have come so far go to `rest`, or, without it, give their vertices. False if
  /// something remains undecided.
  [[nodiscard]] bool run(Task task, unsigned deepest, std::vector<Task>* rest) {
    deepest_ = deepest;
    rest_ = rest;
    halves_.resize(deepest + 1);
    return descend(task.box, task.content, task.depth);
  }

  HullVertices& found() { return vertices_.found; }

 private:
  /// A part's half.
  struct Half {
    PartBox box;
    Content content;
    bool empty = false;          // a view shows nothing of the hull there
    std::optional<PartCut> cut;  // the one that leaves least
  };

  [[nodiscard]] bool descend(const PartBox& box, Content& content, unsigned depth) {
    if (content.views.size() < 2) return true;
    if (content.count <= kFewFacets || depth == deepest_) {
      if (rest_ == nullptr || depth < deepest_) return vertices_.find(box, content.views, content.all_edges());
      rest_->push_back({box, content, depth});
      return true;
    }
    std::array<Half, 2>& halves = halves_[depth];
    divide(box, content, halves);
    for (Half& half : halves) {
      if (!half.empty && !descend(half.box, half.content, depth + 1)) return false;
    }
    return true;
  }

  // Planes are asked first: where some pass, what the window tells from parent to child is little.
  void divide(const PartBox& box, Content& content, std::array<Half, 2>& halves) {
    const std::size_t axis =
        static_cast<std::size_t>(std::max_element(box.half.begin(), box.half.end()) - box.half.begin());
    const double quarter = box.half[axis] / 2;
    for (const std::size_t k : {0U, 1U}) {
      Half& half = halves[k];
      half.box = box;
      half.box.half[axis] = quarter * (1 + kOverlap);
      half.box.middle[axis] += k == 0 ? -quarter : quarter;
      half.content.views.clear();
      half.content.count = 0;
      if (half.content.edges.size() < content.count) half.content.edges.resize(content.count);
      half.empty = false;
      half.cut.reset();
    }
    for (std::size_t v = 0; v < content.views.size() && !(halves[0].empty && halves[1].empty); ++v) {
      const Shown shown = content.views[v];
      const std::array<std::size_t, 2> begins{halves[0].content.count, halves[1].content.count};
      keep_passing(content, shown, axis, quarter, halves);
      for (const std::size_t k : {0U, 1U}) {
        if (halves[k].empty || look(shown.view, begins[k], halves[k])) continue;
        halves[k].empty = true;
        std::swap(content.views[v], content.views[0]);  // it may reject the neighbour, too
      }
    }
    for (Half& half : halves) half.empty = half.empty || (half.cut && !drop_what_it_misses(*half.cut, half.content));
  }

  // Drops views of which nothing passes what the cut leaves, if they show that as object; the view of the cut stays.
  // False if one shows it as background: then nothing is left. The views that stay keep all of their edges.
  bool drop_what_it_misses(const PartCut& cut, Content& content) const {
    std::size_t views = 0;
    std::uint32_t count = 0;
    for (const Shown& shown : content.views) {
      if (shown.view != cut.view() && misses(cut, content, shown)) {
        const EdgeView& view = s_.views[shown.view];
        const std::optional<Seen> seen = view.project({cut.point(), 0});
        const std::optional<bool> inside = seen ? view.inside(*seen, monitor_) : std::nullopt;
        if (inside == false) return false;
        if (inside == true) continue;
      }
      const std::uint32_t begin = count;
      for (std::uint32_t i = shown.begin; i < shown.end; ++i) content.edges[count++] = content.edges[i];
      content.views[views++] = {shown.view, begin, count};
    }
    content.views.resize(views);
    content.count = count;
    return true;
  }

  bool misses(const PartCut& cut, const Content& content, const Shown& shown) const {
    if (shown.begin == shown.end) return false;  // it may not see all of the part
    for (std::uint32_t i = shown.begin; i < shown.end; ++i) {
      if (!cut.misses(facets_[content.edges[i]])) return false;
    }
    return true;
  }

  // Without branches: whether a plane passes a half is as good as random.
  void keep_passing(const Content& content, const Shown& shown, std::size_t axis, double quarter,
                    std::array<Half, 2>& halves) const {
    const PartBox& low = halves[0].box;
    std::uint32_t* const first = halves[0].content.edges.data();
    std::uint32_t* const second = halves[1].content.edges.data();
    std::size_t first_count = halves[0].content.count;
    std::size_t second_count = halves[1].content.count;
    for (std::uint32_t i = shown.begin; i < shown.end; ++i) {
      const std::uint32_t e = content.edges[i];
      const PartFacet& facet = facets_[e];
      const Double3& n = facet.normal;
      const double height = facet.offset + n[0] * low.middle[0] + n[1] * low.middle[1] + n[2] * low.middle[2];
      const double reach =
          facet.error + std::abs(n[0]) * low.half[0] + std::abs(n[1]) * low.half[1] + std::abs(n[2]) * low.half[2];
      first[first_count] = e;
      first_count += std::abs(height) <= reach ? 1 : 0;
      second[second_count] = e;
      second_count += std::abs(height + 2 * quarter * n[axis]) <= reach ? 1 : 0;
    }
    halves[0].content.count = first_count;
    halves[1].content.count = second_count;
  }

  // Notes what a view shows in a half, whose edges have been added from `begin` on. False if it shows nothing of the
  // hull there.
  bool look(std::uint32_t index, std::size_t begin, Half& half) const {
    Content& content = half.content;
    const EdgeView& view = s_.views[index];
    if (const std::optional<EdgeView::Window> window = view.window(half.box.middle, half.box.half)) {
      std::size_t end = begin;
      for (std::size_t i = begin; i < content.count; ++i) {
        const std::uint32_t e = content.edges[i];
        content.edges[end] = e;
        end += beside(facets_[e], *window) ? 0 : 1;
      }
      content.count = end;
      if (end == begin) return middle_inside(view, *window);  // if so, all of the half is in the silhouette
      if (end == begin + 1) consider_cut(index, content.edges[begin], *window, half);
    }
    content.views.push_back({index, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(content.count)});
    return true;
  }

  void consider_cut(std::uint32_t view, std::uint32_t e, const EdgeView::Window& window, Half& half) const {
    const std::optional<PartCut> cut = PartCut::make(view, facets_[e], s_.edges[e], half.box, window);
    if (cut && (!half.cut || cut->share() < half.cut->share())) half.cut = cut;
  }

  // No edge comes near the window, so its middle tells of all of it.
  bool middle_inside(const EdgeView& view, const EdgeView::Window& window) const {
    const auto [u, v] = window.middle;
    if (const std::optional<bool> inside = view.inside({u, v, 0}, monitor_)) return *inside;
    return view.locate(Point2::from_doubles(u, v), monitor_) != Side::kOutside;
  }

  static bool beside(const PartFacet& facet, const EdgeView::Window& window) {
    for (std::size_t k = 0; k < 2; ++k) {
      if (facet.low[k] > window.middle[k] + window.half[k]) return true;
      if (facet.high[k] < window.middle[k] - window.half[k]) return true;
    }
    return false;
  }

  const EdgeScene& s_;
  const std::vector<PartFacet>& facets_;
  nef::Monitor monitor_;
  PartVertices vertices_;
  std::vector<std::array<Half, 2>> halves_;  // by depth
  unsigned deepest_ = 0;
  std::vector<Task>* rest_ = nullptr;
};

Task everything(const EdgeScene& scene) {
  Task all;
  for (std::size_t k = 0; k < 3; ++k) {
    all.box.middle[k] = (scene.low[k] + scene.high[k]) / 2;
    all.box.half[k] = (scene.high[k] - scene.low[k]) / 2 * (1 + kOverlap);
  }
  for (std::uint32_t v = 0; v < scene.views.size(); ++v) {
    const EdgeView& view = scene.views[v];
    all.content.views.push_back({v, view.first_edge(), view.first_edge() + view.edge_count()});
  }
  for (std::uint32_t e = 0; e < scene.edges.size(); ++e) all.content.edges.push_back(e);
  all.content.count = scene.edges.size();
  return all;
}

// Leaves the first one of equal names, and all names in their order.
void drop_repeated(std::vector<SpotName>& names, const nef::Monitor& monitor) {
  auto shares = nef::shared_out<SpotName>(
      names.size(), monitor, [&](std::size_t i, const auto& put) { put(names[i][0] % nef::kShares, names[i]); });
  nef::parallel_for(nef::kShares, monitor,
                    [&shares](std::size_t s, const nef::Monitor&) { std::sort(shares[s].begin(), shares[s].end()); });
  std::map<SpotName, bool> met;  // of the repeated ones, which are few
  for (const std::vector<SpotName>& sorted : shares) {
    for (auto at = sorted.begin(); (at = std::adjacent_find(at, sorted.end())) != sorted.end(); ++at) met[*at] = false;
  }
  if (met.empty()) return;
  std::erase_if(names, [&met](const SpotName& name) {
    const auto at = met.find(name);
    return at != met.end() && std::exchange(at->second, true);
  });
}

// Parts overlap, and three of many planes may be asked for twice.
HullVertices together(std::vector<HullVertices>& parts, const nef::Monitor& monitor) {
  HullVertices all;
  for (HullVertices& part : parts) {
    all.plain.insert(all.plain.end(), part.plain.begin(), part.plain.end());
    std::move(part.crowded.begin(), part.crowded.end(), std::back_inserter(all.crowded));
  }
  drop_repeated(all.plain, monitor);
  std::sort(all.crowded.begin(), all.crowded.end(),
            [](const CrowdedVertex& a, const CrowdedVertex& b) { return a.point < b.point; });
  const auto same = [](const CrowdedVertex& a, const CrowdedVertex& b) { return a.point == b.point; };
  all.crowded.erase(std::unique(all.crowded.begin(), all.crowded.end(), same), all.crowded.end());
  return all;
}

}  // namespace

std::optional<HullVertices> hull_vertices(const EdgeScene& scene, const nef::Monitor& monitor) {
  const std::vector<PartFacet> facets = facets_of(scene);
  std::vector<HullVertices> found;
  std::vector<Task> tasks{everything(scene)};
  std::atomic<bool> decided = true;
  for (const unsigned depth : kStages) {
    const std::size_t first = found.size();
    found.resize(first + tasks.size());
    std::vector<std::vector<Task>> rest(tasks.size());
    nef::parallel_for(tasks.size(), monitor, [&](std::size_t k, const nef::Monitor& own) {
      if (!decided.load(std::memory_order_relaxed)) return;
      Halving halving(scene, facets, own);
      std::vector<Task>* const left = depth == kDeepest ? nullptr : &rest[k];
      if (!halving.run(std::move(tasks[k]), depth, left)) decided.store(false, std::memory_order_relaxed);
      found[first + k] = std::move(halving.found());
    });
    if (!decided) return std::nullopt;
    tasks.clear();
    for (std::vector<Task>& some : rest) std::move(some.begin(), some.end(), std::back_inserter(tasks));
  }
  return together(found, monitor);
}

}  // namespace nef::visual_hull

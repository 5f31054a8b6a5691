// SPDX-License-Identifier: Apache-2.0
//
// The drawing around a point gives a graph: its regions, with a step from the back of each facet to its front. The
// point may be a passage unless all ways through this graph can be continued to one region (the header has the proof);
// the same test, on the sectors around an svertex, decides for edges. An arc or loop may be one if facets look to both
// of its sides.
//
// Items that may be passages become questions, which hold pointers to the marks. `answer` puts them to the definition,
// in blocks, on several threads; every other mark is already final.
#include "apps/minkowski/convolution/marks/boundary_marker.h"

#include <algorithm>

#include "apps/minkowski/convolution/marks/direction_into.h"
#include "apps/minkowski/minkowski.h"
#include "nef/base/threads/parallel.h"
#include "nef/sphere_map/sphere_geometry.h"

namespace nef::minkowski {
namespace {

// Regions and the steps between neighbours from the back of a facet to its front.
class Steps {
 public:
  explicit Steps(std::size_t regions) : next_(regions) {}

  void add(std::size_t from, std::size_t to) { next_[from].push_back(to); }

  // True if all ways can be continued to one place.
  [[nodiscard]] bool have_one_end() const {
    std::vector<std::vector<bool>> reached;
    for (std::size_t r = 0; r < next_.size(); ++r) reached.push_back(reached_from(r));
    for (std::size_t end = 0; end < next_.size(); ++end) {
      if (std::all_of(reached.begin(), reached.end(), [end](const std::vector<bool>& from) { return from[end]; })) {
        return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] std::vector<bool> reached_from(std::size_t start) const {
    std::vector<bool> reached(next_.size(), false);
    std::vector<std::size_t> open{start};
    reached[start] = true;
    while (!open.empty()) {
      const std::size_t r = open.back();
      open.pop_back();
      for (const std::size_t n : next_[r]) {
        if (reached[n]) continue;
        reached[n] = true;
        open.push_back(n);
      }
    }
    return reached;
  }

  std::vector<std::vector<std::size_t>> next_;
};

// True if the region of an arc or loop is just behind a facet in it.
template <typename Half>
bool is_behind(const Half& half) {
  return (half.mark & (half.plane.flipped() ? kOutsideAbove : kOutsideBelow)) != 0;
}

// True if the regions on both sides are.
template <typename Half>
bool is_behind_and_before(const Half& half) {
  return (half.mark & kOutsideAbove) != 0 && (half.mark & kOutsideBelow) != 0;
}

template <typename Halves>
void add_steps(const Halves& halves, Steps& steps) {
  for (std::uint32_t h = 0; h < halves.size(); ++h) {
    if (is_behind(halves[h]) && !is_behind_and_before(halves[h])) steps.add(halves[h].sface, halves[h ^ 1U].sface);
  }
}

bool centre_may_be_passage(const SphereMapView& map) {
  Steps steps(map.sfaces.size());
  add_steps(map.shalfedges, steps);
  add_steps(map.sloops, steps);
  return !steps.have_one_end();
}

// The shalfedges that leave an svertex, counterclockwise; the sector to the left of each is the next one's right.
std::vector<std::uint32_t> around(const SphereMapView& map, std::uint32_t svertex) {
  std::vector<std::uint32_t> result;
  std::uint32_t e = map.svertices[svertex].out;
  do {
    result.push_back(e);
    e = map.next_around(e);
  } while (e != map.svertices[svertex].out);
  return result;
}

bool edge_may_be_passage(const SphereMapView& map, const std::vector<std::uint32_t>& arcs) {
  const std::size_t n = arcs.size();
  Steps steps(n);
  for (std::size_t i = 0; i < n; ++i) {
    const SHalfedge& e = map.shalfedges[arcs[i]];
    const std::size_t left = i;
    const std::size_t right = (i + n - 1) % n;
    if (is_behind_and_before(e)) continue;
    if (is_behind(e)) {
      steps.add(left, right);
    } else {
      steps.add(right, left);
    }
  }
  return !steps.have_one_end();
}

}  // namespace

bool BoundaryMarker::may_have_passages(const SphereMapView& map) {
  if (std::any_of(map.shalfedges.begin(), map.shalfedges.end(), is_behind_and_before<SHalfedge>)) return true;
  if (std::any_of(map.sloops.begin(), map.sloops.end(), is_behind_and_before<SLoop>)) return true;
  for (std::uint32_t s = 0; s < map.svertices.size(); ++s) {
    if (edge_may_be_passage(map, around(map, s))) return true;
  }
  return centre_may_be_passage(map);
}

void BoundaryMarker::mark(PointId point, bool is_saddle_point, SphereMapBuffer& map) {
  const SphereMapBuffer drawn = map;
  const SphereMapView view = drawn.view();
  const auto inside = [&](std::uint32_t sface) { return view.sfaces[sface].mark != 0; };
  const auto told = [](LabelId mark) { return static_cast<LabelId>((mark & kInSum) != 0 ? 1 : 0); };
  const auto ask_towards = [&](const Direction& direction, LabelId& mark, LabelId& twin) {
    ask(pyramids_.point_towards(facets_.points, point, direction, monitor_), mark, twin);
  };
  for (std::uint32_t e = 0; e < view.shalfedges.size(); e += 2) {
    const SHalfedge& half = view.shalfedges[e];
    const bool enclosed = inside(half.sface) && inside(view.shalfedges[e + 1].sface);
    LabelId& mark = map.shalfedges[e].mark;
    LabelId& twin = map.shalfedges[e + 1].mark;
    mark = twin = enclosed ? 1 : told(half.mark);
    if (enclosed && is_behind_and_before(half))
      ask_towards(direction_on_arc(facets_.planes, view, e, monitor_), mark, twin);
  }
  for (std::uint32_t l = 0; l < view.sloops.size(); l += 2) {
    const SLoop& half = view.sloops[l];
    const bool enclosed = inside(half.sface) && inside(view.sloops[l + 1].sface);
    LabelId& mark = map.sloops[l].mark;
    LabelId& twin = map.sloops[l + 1].mark;
    mark = twin = enclosed ? 1 : told(half.mark);
    if (enclosed && is_behind_and_before(half)) {
      ask_towards(direction_on_circle(facets_.planes, half.plane), mark, twin);
    }
  }
  for (std::uint32_t s = 0; s < view.svertices.size(); ++s) {
    const std::vector<std::uint32_t> arcs = around(view, s);
    const bool enclosed =
        std::all_of(arcs.begin(), arcs.end(), [&](std::uint32_t e) { return inside(view.shalfedges[e].sface); });
    LabelId& mark = map.svertices[s].mark;
    mark = enclosed ? 1 : told(view.svertices[s].mark);
    if (enclosed && edge_may_be_passage(view, arcs)) {
      ask_towards(direction_of(facets_.planes, view.svertices[s]), mark, mark);
    }
  }
  const bool enclosed = std::all_of(view.sfaces.begin(), view.sfaces.end(), [](const SFace& f) { return f.mark != 0; });
  map.mark = enclosed ? 1 : told(view.mark);
  if (enclosed && (is_saddle_point || centre_may_be_passage(view))) {
    ask(facets_.points.rational(point), map.mark, map.mark);
  }
}

std::size_t BoundaryMarker::answer(const SumMembership& membership) {
  constexpr std::size_t kBlock = 256;
  for (std::size_t first = 0; first < questions_.size(); first += kBlock) {
    monitor_.tell_progress(kSumPhase, first, questions_.size());
    parallel_for(std::min(kBlock, questions_.size() - first), monitor_, [&](std::size_t k, const Monitor& own) {
      const Question& q = questions_[first + k];
      *q.mark = *q.twin = membership.in_sum(q.point, own) ? 1 : 0;
    });
  }
  return static_cast<std::size_t>(
      std::count_if(questions_.begin(), questions_.end(), [](const Question& q) { return *q.mark == 0; }));
}

}  // namespace nef::minkowski

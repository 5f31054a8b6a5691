// SPDX-License-Identifier: Apache-2.0
//
// A vertex of the hull is a point of three planes: of three views, or of two neighbours in one silhouette and one of
// another view. It lies on the three edges and in all other silhouettes. Where doubles do not decide, integers do. What
// lies in the boundary of a silhouette, but for its own edges, is crowded, unless another view rejects it: every vertex
// in a degenerate position lies on three such planes, too, so none goes unseen.
#include "apps/visual_hull/viewing_edges/part_vertices.h"

#include <bit>
#include <cmath>

#include "nef/geometry/vectors.h"
#include "nef/number/nearest_quotient.h"

namespace nef::visual_hull {
namespace {

Spot nearest_spot(const ExactPoint& x) {
  Spot spot;
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    spot.at[k] = nef::nearest_quotient(x[k].get_mpz_t(), x[3].get_mpz_t());
    largest = std::max(largest, std::abs(spot.at[k]));
  }
  spot.error = largest * kRounding;
  return spot;
}

}  // namespace

bool PartVertices::find(const PartBox& box, std::span<const Shown> views, std::span<const std::uint32_t> edges) {
  for (const Shown& shown : views) {
    if (shown.begin == shown.end) return false;  // it was never seen whether that is in its silhouette
  }
  box_ = box;
  collect(views, edges);
  pair_up();
  first_crowded_ = found.crowded.size();
  for (std::size_t a = 0; a < facets_.size(); ++a) {
    const std::uint64_t* with_a = &meet_[a * words_];
    for (std::size_t v = 0; v < words_; ++v) {
      for (std::uint64_t left = with_a[v]; left != 0; left &= left - 1) {
        const std::size_t b = 64 * v + static_cast<std::size_t>(std::countr_zero(left));
        const std::uint64_t* with_b = &meet_[b * words_];
        for (std::size_t w = v; w < words_; ++w) {
          for (std::uint64_t both = with_a[w] & with_b[w]; both != 0; both &= both - 1) {
            const std::size_t c = 64 * w + static_cast<std::size_t>(std::countr_zero(both));
            if (facets_[a].view != facets_[c].view && !consider(views, a, b, c)) return false;
          }
        }
      }
    }
  }
  return true;
}

void PartVertices::collect(std::span<const Shown> views, std::span<const std::uint32_t> edges) {
  facets_.clear();
  const double reach = s_.farthest[0] + s_.farthest[1] + s_.farthest[2];
  for (const Shown& shown : views) {
    for (std::uint32_t i = shown.begin; i < shown.end; ++i) {
      const ViewingEdge& edge = s_.edges[edges[i]];
      CubePlane plane;
      plane.offset = edge.offset;
      double size = std::abs(edge.offset);
      for (std::size_t k = 0; k < 3; ++k) {
        const double term = edge.normal.at[k] * box_.middle[k];
        plane.offset += term;
        size += std::abs(term);
        plane.normal[k] = edge.normal.at[k] * box_.half[k];
        plane.size += std::abs(plane.normal[k]);
      }
      plane.error = (size + plane.size) * kRounding + edge.offset_error + 1.0001 * reach * edge.normal.error;
      facets_.push_back({edges[i], shown.view, plane});
    }
  }
}

// Two edges of one view bound the hull together only where one begins at the end of the other.
bool PartVertices::neighbours(std::uint32_t e, std::uint32_t f) const {
  const std::vector<ViewingEdge>& edges = s_.edges;
  return (edges[f].previous == e && edges[f].place == f) || (edges[e].previous == f && edges[e].place == e);
}

void PartVertices::pair_up() {
  const std::size_t n = facets_.size();
  crosses_.resize(n * n);
  words_ = (n + 63) / 64;
  meet_.assign(n * words_, 0);
  for (std::size_t a = 0; a < n; ++a) {
    const Facet& p = facets_[a];
    for (std::size_t b = a + 1; b < n; ++b) {
      const Facet& q = facets_[b];
      if (p.view == q.view && !neighbours(p.edge, q.edge)) continue;
      const Double3 d = nef::cross(p.plane.normal, q.plane.normal);
      if (!may_meet_in_cube(p.plane, q.plane, d)) continue;
      meet_[a * words_ + b / 64] |= std::uint64_t{1} << b % 64;
      crosses_[a * n + b] = d;
    }
  }
}

bool PartVertices::consider(std::span<const Shown> views, std::size_t a, std::size_t b, std::size_t c) {
  CubePoint at;
  const Answer in_part = meet_in_cube(facets_[a].plane, facets_[b].plane, facets_[c].plane, cross_of(a, b),
                                      cross_of(a, c), cross_of(b, c), at);
  if (in_part == Answer::kNo) return true;
  const SpotName name = sorted_name(facets_[a].edge, facets_[b].edge, facets_[c].edge);
  if (in_crowd(name)) return true;
  if (in_part == Answer::kVague) return consider_exactly(views, name);
  Spot spot;
  double half = 0;
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    spot.at[k] = box_.middle[k] + box_.half[k] * at.at[k];
    half = std::max(half, box_.half[k]);
    largest = std::max(largest, std::abs(spot.at[k]));
  }
  spot.error = half * at.error + largest * kRounding;
  const Answer answer = on_hull(views, name, spot, nullptr);
  if (answer == Answer::kYes) found.plain.push_back(name);
  return answer != Answer::kVague || consider_exactly(views, name);
}

bool PartVertices::consider_exactly(std::span<const Shown> views, const SpotName& name) {
  if (!s_.may_be_exact()) return false;
  const std::optional<ExactPoint> exact = s_.exact(name);
  if (!exact) return true;
  const Spot spot = nearest_spot(*exact);
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::abs(spot.at[k] - box_.middle[k]) > box_.half[k]) return true;  // it is in a neighbour
  }
  const Answer answer = on_hull(views, name, spot, &*exact);
  if (answer == Answer::kYes) found.plain.push_back(name);
  return answer != Answer::kVague || add_crowded(views, *exact, spot);
}

bool PartVertices::add_crowded(std::span<const Shown> views, const ExactPoint& exact, const Spot& spot) {
  CrowdedVertex vertex;
  for (const Shown& shown : views) {
    const EdgeView& view = s_.views[shown.view];
    const std::optional<Seen> seen = view.project(spot);
    if (!seen || !view.edges_at(*seen, exact, vertex.edges)) return false;
  }
  std::sort(vertex.edges.begin(), vertex.edges.end());
  for (std::size_t k = 0; k < 3; ++k) {
    vertex.point[k] = Rational(exact[k], exact[3]);
    vertex.point[k].canonicalize();
  }
  found.crowded.push_back(std::move(vertex));
  return true;
}

// Three planes through a crowded vertex meet there, or not in a point.
bool PartVertices::in_crowd(const SpotName& name) const {
  for (std::size_t i = first_crowded_; i < found.crowded.size(); ++i) {
    const std::vector<std::uint32_t>& edges = found.crowded[i].edges;
    const auto there = [&edges](std::uint32_t e) { return std::binary_search(edges.begin(), edges.end(), e); };
    if (there(name[0]) && there(name[1]) && there(name[2])) return true;
  }
  return false;
}

// With the exact point, vague is what lies in the boundary of a silhouette.
Answer PartVertices::on_hull(std::span<const Shown> views, const SpotName& name, const Spot& spot,
                             const ExactPoint* exact) const {
  bool vague = false;
  std::array<std::uint32_t, 3> own{};
  for (std::size_t i = 0; i < 3; ++i) own[i] = s_.edges[name[i]].view;
  for (std::size_t i = 0; i < 3; ++i) {
    if (own[i] == own[(i + 1) % 3] || own[i] == own[(i + 2) % 3]) continue;  // the corner of two edges: there it lies
    const EdgeView& view = s_.views[own[i]];
    const std::optional<Seen> seen = view.project(spot);
    std::optional<bool> between = seen ? view.between(*seen, name[i]) : std::nullopt;
    if (!between && exact != nullptr) {
      const Side side = view.between(*exact, name[i], monitor_);
      if (side != Side::kBoundary) between = side == Side::kInside;
    }
    if (between == false) return Answer::kNo;
    vague = vague || !between;
  }
  for (const Shown& shown : views) {
    if (shown.view == own[0] || shown.view == own[1] || shown.view == own[2]) continue;
    const EdgeView& view = s_.views[shown.view];
    const std::optional<Seen> seen = view.project(spot);
    std::optional<bool> inside;
    if (seen) inside = view.inside(*seen, monitor_);
    if (!inside && exact != nullptr && seen) {
      const std::optional<Side> side = view.locate(*seen, *exact, monitor_);
      if (side && *side != Side::kBoundary) inside = *side == Side::kInside;
    }
    if (inside == false) return Answer::kNo;
    vague = vague || !inside;
  }
  return vague ? Answer::kVague : Answer::kYes;
}

}  // namespace nef::visual_hull

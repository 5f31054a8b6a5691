// SPDX-License-Identifier: Apache-2.0
//
// The Boolean operations of the public interface.
#include <algorithm>
#include <queue>

#include "nef/base/parallel.h"
#include "nef/boolean/overlay_complexes.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

using Function = std::function<LabelId(LabelId, LabelId)>;

bool apart(const Polyhedron& a, const Polyhedron& b) {
  const auto bounds = [](const Complex& c) {
    Box box;
    for (std::uint32_t v = 0; v < c.vertex_count(); ++v) box.add_rounded(c.points.approximate(PointId{v}));
    return box;
  };
  return !bounds(a.complex()).overlaps(bounds(b.complex()));
}

using Combine = Polyhedron (*)(const Polyhedron&, const Polyhedron&);

// Combines pairwise, smallest first, so that no large result is copied many times.
Polyhedron combine_smallest_first(std::span<const Polyhedron> sets, Combine combine) {
  struct Entry {
    std::size_t size;
    std::size_t order;
    Polyhedron set;
  };
  const auto later = [](const Entry& x, const Entry& y) {
    return x.size != y.size ? x.size > y.size : x.order > y.order;
  };
  std::priority_queue<Entry, std::vector<Entry>, decltype(later)> queue(later);
  std::size_t order = 0;
  for (const Polyhedron& set : sets) queue.push({set.complex().vertex_count(), order++, set});
  while (queue.size() > 1) {
    const Polyhedron a = queue.top().set;
    queue.pop();
    const Polyhedron b = queue.top().set;
    queue.pop();
    Polyhedron c = combine(a, b);
    queue.push({c.complex().vertex_count(), order++, std::move(c)});
  }
  return queue.top().set;
}

// The same in rounds: sets of similar size form pairs, all pairs of a round are combined at once.
Polyhedron combine_in_rounds(std::span<const Polyhedron> sets, Combine combine, unsigned threads) {
  std::vector<Polyhedron> left(sets.begin(), sets.end());
  while (left.size() > 1) {
    std::stable_sort(left.begin(), left.end(), [](const Polyhedron& x, const Polyhedron& y) {
      return x.complex().vertex_count() < y.complex().vertex_count();
    });
    const std::size_t pairs = left.size() / 2;
    std::vector<Polyhedron> next(pairs);
    parallel_for(pairs, threads, [&](std::size_t i) { next[i] = combine(left[2 * i], left[2 * i + 1]); });
    if (left.size() % 2 == 1) next.push_back(left.back());
    left = std::move(next);
  }
  return left.front();
}

Polyhedron combine_all(std::span<const Polyhedron> sets, Combine combine, unsigned threads) {
  // Rounds cost a little more in all, so a single thread, or one pair, goes without.
  return threads == 1 || sets.size() < 4 ? combine_smallest_first(sets, combine)
                                         : combine_in_rounds(sets, combine, threads);
}

}  // namespace

Polyhedron overlay(const Polyhedron& a, const Polyhedron& b, const Function& f) {
  const Complex& ca = a.complex();
  const Complex& cb = b.complex();
  const LabelFunction table(ca.label_count, cb.label_count, f);
  return Polyhedron(overlay_complexes(
      ca, cb, table, [&a]() -> const QueryStructure& { return a.queries(); },
      [&b]() -> const QueryStructure& { return b.queries(); }));
}

Polyhedron unite(const Polyhedron& a, const Polyhedron& b) {
  if (a.is_empty() || b.is_everything()) return b;
  if (b.is_empty() || a.is_everything()) return a;
  return overlay(a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x != 0 || y != 0); });
}

Polyhedron intersect(const Polyhedron& a, const Polyhedron& b) {
  if (a.is_empty() || b.is_everything()) return a;
  if (b.is_empty() || a.is_everything()) return b;
  if (a.is_bounded() && b.is_bounded() && apart(a, b)) return {};
  return overlay(a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x != 0 && y != 0); });
}

Polyhedron subtract(const Polyhedron& a, const Polyhedron& b) {
  if (a.is_empty() || b.is_empty()) return a;
  if (a.is_bounded() && b.is_bounded() && apart(a, b)) return a;
  return overlay(a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x != 0 && y == 0); });
}

Polyhedron symmetric_difference(const Polyhedron& a, const Polyhedron& b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return overlay(a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>((x != 0) != (y != 0)); });
}

Polyhedron unite_all(std::span<const Polyhedron> sets, unsigned threads) {
  return sets.empty() ? Polyhedron() : combine_all(sets, unite, threads);
}

Polyhedron intersect_all(std::span<const Polyhedron> sets, unsigned threads) {
  return sets.empty() ? Polyhedron::everything() : combine_all(sets, intersect, threads);
}

bool equal(const Polyhedron& a, const Polyhedron& b) {
  const Complex& ca = a.complex();
  const Complex& cb = b.complex();
  // The representation is unique: different counts settle it without geometry.
  if (ca.vertex_count() != cb.vertex_count() || ca.edge_count() != cb.edge_count() ||
      ca.facet_count() != cb.facet_count() || ca.volume_count() != cb.volume_count() ||
      ca.volumes[0].mark != cb.volumes[0].mark) {
    return false;
  }
  return overlay(a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x != y); }).is_empty();
}

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
//
// The Boolean operations of the public interface.
#include <algorithm>
#include <atomic>
#include <optional>

#include "nef/base/error.h"
#include "nef/base/threads/parallel.h"
#include "nef/boolean/overlay_complexes.h"
#include "nef/complex/item_boxes.h"
#include "nef/polyhedron.h"

namespace nef {
namespace {

using Function = std::function<LabelId(LabelId, LabelId)>;

bool apart(const Polyhedron& a, const Polyhedron& b) {
  return !vertices_box(a.complex()).overlaps(vertices_box(b.complex()));
}

// How many of some sets, sorted by size, are to be intersected before the others: a set that is larger than all before
// it together waits, so that no large result is copied many times.
std::size_t first_to_intersect(std::span<const Polyhedron> sets) {
  std::size_t count = 0;
  std::size_t vertices = 0;
  while (count < sets.size() && (count < 2 || sets[count].complex().vertex_count() <= vertices)) {
    vertices += sets[count++].complex().vertex_count();
  }
  return count;
}

}  // namespace

Polyhedron overlay(const Polyhedron& a, const Polyhedron& b, const Function& f, const Monitor& monitor) {
  const Complex& ca = a.complex();
  const Complex& cb = b.complex();
  const LabelFunction table(ca.label_count, cb.label_count, [&f](LabelId x, LabelId y) {
    const LabelId mark = f(x, y);
    if (mark == kOutside) {
      throw InputError("the function of an overlay gave the mark " + std::to_string(kOutside) + " for the marks " +
                       std::to_string(x) + " and " + std::to_string(y) +
                       "; that mark is reserved for what lies beyond an infimaximal box");
    }
    return mark;
  });
  std::optional<Complex> result = overlay_complexes(
      ca, cb, table, [&a]() -> const QueryStructure& { return a.queries(); },
      [&b]() -> const QueryStructure& { return b.queries(); },
      for_vertices(ca.vertex_count() + cb.vertex_count(), monitor));
  return result ? Polyhedron(std::move(*result)) : a;
}

Polyhedron unite(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  if (a.is_empty() || b.is_everything()) return without_labels(b, monitor);
  if (b.is_empty() || a.is_everything()) return without_labels(a, monitor);
  return overlay(
      a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x != 0 || y != 0); }, monitor);
}

Polyhedron intersect(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  if (a.is_empty() || b.is_everything()) return without_labels(a, monitor);
  if (b.is_empty() || a.is_everything()) return without_labels(b, monitor);
  if (a.is_bounded() && b.is_bounded() && apart(a, b)) return {};
  return overlay(
      a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x != 0 && y != 0); }, monitor);
}

Polyhedron subtract(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  if (a.is_empty() || b.is_empty()) return without_labels(a, monitor);
  if (a.is_bounded() && b.is_bounded() && apart(a, b)) return without_labels(a, monitor);
  return overlay(
      a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>(x != 0 && y == 0); }, monitor);
}

Polyhedron symmetric_difference(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  if (a.is_empty()) return without_labels(b, monitor);
  if (b.is_empty()) return without_labels(a, monitor);
  return overlay(
      a, b, [](LabelId x, LabelId y) { return static_cast<LabelId>((x != 0) != (y != 0)); }, monitor);
}

// In rounds: sets of similar size form pairs, and all pairs of a round are intersected at once. The order does not
// depend on the number of threads, so neither does the order of items in the result.
Polyhedron intersect_all(std::span<const Polyhedron> sets, const Monitor& monitor) {
  if (sets.empty()) return Polyhedron::everything();
  std::vector<Polyhedron> left(sets.begin(), sets.end());
  std::atomic<std::size_t> done{0};
  while (left.size() > 1) {
    std::stable_sort(left.begin(), left.end(), [](const Polyhedron& x, const Polyhedron& y) {
      return x.complex().vertex_count() < y.complex().vertex_count();
    });
    const std::size_t pairs = first_to_intersect(left) / 2;
    std::vector<Polyhedron> next(pairs);
    parallel_for(pairs, monitor, [&](std::size_t i, const Monitor& own) {
      // Many small operations tell of themselves as one; a single one, of what it does.
      const Monitor of_pair = sets.size() > 2 ? own.quiet() : own;
      next[i] = intersect(left[2 * i], left[2 * i + 1], of_pair);
      if (sets.size() > 2) own.tell_progress("sets", ++done, sets.size() - 1);
    });
    next.insert(next.end(), left.begin() + static_cast<std::ptrdiff_t>(2 * pairs), left.end());
    left = std::move(next);
  }
  return without_labels(left.front(), monitor);
}

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
//
// `tighten` alternates three changes until none helps: the string pulled around the edges in a corner's triangle
// (triangle_pull.cpp), way-points slid along their edges, and shortcuts. The best place on an edge has a closed form,
// by unfolding both sides about the edge. A new place is taken as the simplest rational near the double, halved towards
// the old one if the motion is not free. Tests that failed are remembered by their rounded points. In the end
// way-points move to simpler numbers nearby, where this costs less than doubles can tell.
#include "apps/planner/path/shorten.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "apps/planner/intersection/vectors.h"
#include "nef/number/simplest_between.h"

namespace nef::planner {
namespace {

// How much of a segment is contact: its parts in cells thinner than the space around them.
int contact_count(const FreeSpace& free, const Rational3& a, const Rational3& b) {
  int count = 0;
  for (const CellOnSegment& on : cells_along(free, a, b)) {
    if (free.cells().dimension(on.cell) < 3) ++count;
  }
  return count;
}

bool keeps_clearance(const FreeSpace& free, const Waypoints& path, std::size_t i, std::size_t j) {
  const int direct = contact_count(free, path[i], path[j]);
  int before = 0;
  for (std::size_t k = i; k < j; ++k) before += contact_count(free, path[k], path[k + 1]);
  // Way-points in contact between two segments were counted twice.
  for (std::size_t k = i + 1; k < j; ++k) {
    if (free.cells().dimension(free.locate(ExactPoint(path[k]))) < 3) --before;
  }
  return direct <= before;
}

// The parameter on the line e0 + t d at which |a - x| + |x - c| is least: unfold both about it.
double best_parameter(const Vector3d& e0, const Vector3d& d, const Vector3d& a, const Vector3d& c) {
  const double ta = (a - e0).dot(d) / d.squaredNorm();
  const double tc = (c - e0).dot(d) / d.squaredNorm();
  const double ha = (a - e0 - ta * d).norm();
  const double hc = (c - e0 - tc * d).norm();
  return ha + hc > 0 ? (ta * hc + tc * ha) / (ha + hc) : ta;
}

// The free edges that the point lies on or ends.
std::vector<CellId> edges_at(const FreeSpace& free, const Rational3& point) {
  const CellId cell = free.locate(ExactPoint(point));
  if (free.cells().dimension(cell) == 1) return {cell};
  std::vector<CellId> result;
  if (free.cells().dimension(cell) == 0) {
    for (const CellId other : free.neighbours(cell)) {
      if (free.cells().dimension(other) == 1) result.push_back(other);
    }
  }
  return result;
}

// Moves a way-point if that is allowed and the way over it becomes shorter than `most` times what it is.
bool try_replace(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t i, const Rational3& x,
                 double most) {
  const double before = distance(path[i - 1], path[i]) + distance(path[i], path[i + 1]);
  const double after = distance(path[i - 1], x) + distance(x, path[i + 1]);
  if (!(after < most * before)) return false;
  if (!segment_allowed(free, filter, path[i - 1], x) || !segment_allowed(free, filter, x, path[i + 1])) return false;
  path[i] = x;
  return true;
}

// The best place for a way-point on one of the edges that it is on, as a simple point within `slack` of the edge;
// nothing if it is beyond the ends and `inside`.
std::optional<Rational3> best_place(const FreeSpace& free, const Waypoints& path, std::size_t i, CellId edge,
                                    double slack, bool inside) {
  const std::vector<Rational3> ends = free.vertices(edge);
  const Vector3d e0 = to_vector(ends[0]);
  const Vector3d d = to_vector(ends[1]) - e0;
  double t = best_parameter(e0, d, to_vector(path[i - 1]), to_vector(path[i + 1]));
  if (!std::isfinite(t) || (inside && (t < 0 || t > 1))) return std::nullopt;
  t = std::clamp(t, 0.0, 1.0);
  const Rational low = std::max(Rational(0), Rational(t - slack));
  const Rational high = std::min(Rational(1), Rational(t + slack));
  return point_between(ends[0], ends[1], simplest_between(low, high));
}

bool slide(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t i) {
  bool changed = false;
  for (const CellId edge : edges_at(free, path[i])) {
    std::optional<Rational3> x = best_place(free, path, i, edge, 1e-7, false);
    for (int halving = 0; x && halving < 4 && *x != path[i]; ++halving) {
      if (try_replace(free, filter, path, i, *x, 1 - 1e-13)) {
        changed = true;
        break;
      }
      x = point_between(*x, path[i], Rational(1, 2));
    }
  }
  return changed;
}

std::size_t bits(const Rational3& x) {
  std::size_t sum = 0;
  for (const Rational& value : x) sum += mpz_sizeinbase(value.get_den_mpz_t(), 2);
  return sum;
}

// Where sliding has converged, an optimum with small numbers is most likely the true one: takes
// the simplest point nearby if that costs nothing that doubles can see.
void polish(const FreeSpace& free, const CellFilter& filter, Waypoints& path, std::size_t i) {
  for (const CellId edge : edges_at(free, path[i])) {
    const std::optional<Rational3> x = best_place(free, path, i, edge, 1e-6, true);
    if (x && bits(*x) < bits(path[i]) && try_replace(free, filter, path, i, *x, 1 + 1e-12)) return;
  }
}

// What was tried in vain is not tried again: most of a path stays as it is from round to round. Points that doubles
// cannot tell apart count as the same, so maybe something is not tried at all.
struct TriedInVain {
  std::set<std::array<double, 6>> shortcuts;
  std::set<std::array<double, 9>> pulls;   // of a way-point with its neighbours
  std::set<std::array<double, 9>> slides;  // ...
};

template <typename... Points>
auto key_of(const Points&... points) {
  std::array<double, 3 * sizeof...(points)> key{};
  std::size_t i = 0;
  const auto append = [&](const Rational3& point) {
    for (const Rational& x : point) key[i++] = nearest_double(x);
  };
  (append(points), ...);
  return key;
}

bool may_use(const FreeSpace& free, const CellFilter& filter, const Rational3& a, const Rational3& b,
             TriedInVain* tried) {
  if (tried == nullptr) return segment_allowed(free, filter, a, b);
  const std::array<double, 6> key = key_of(a, b);
  if (tried->shortcuts.contains(key)) return false;
  if (segment_allowed(free, filter, a, b)) return true;
  tried->shortcuts.insert(key);
  return false;
}

void leave_out(const FreeSpace& free, const CellFilter& filter, Waypoints& path, bool clearance, TriedInVain* tried) {
  for (std::size_t i = 0; i + 2 < path.size(); ++i) {
    for (std::size_t j = path.size() - 1; j > i + 1; --j) {
      if (!may_use(free, filter, path[i], path[j], tried)) continue;
      if (clearance && !keeps_clearance(free, path, i, j)) continue;
      path.erase(path.begin() + static_cast<std::ptrdiff_t>(i) + 1, path.begin() + static_cast<std::ptrdiff_t>(j));
      break;
    }
  }
}

// Does something with each way-point between the ends that did not fail with the same neighbours before.
template <typename Change>
bool change_each(Waypoints& path, std::set<std::array<double, 9>>& tried, const Change& change) {
  bool changed = false;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const std::array<double, 9> corner = key_of(path[i - 1], path[i], path[i + 1]);
    if (tried.contains(corner)) continue;
    if (change(i)) {
      changed = true;
    } else {
      tried.insert(corner);
    }
  }
  return changed;
}

}  // namespace

double length_of(const Waypoints& path) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) sum += distance(path[i], path[i + 1]);
  return sum;
}

void shortcut(const FreeSpace& free, const CellFilter& filter, Waypoints& path, bool clearance) {
  leave_out(free, filter, path, clearance, nullptr);
}

void tighten(const FreeSpace& free, const CellFilter& filter, Waypoints& path, int rounds) {
  double length = length_of(path);
  TriedInVain tried;
  for (int round = 0; round < rounds; ++round) {
    const bool pulled =
        change_each(path, tried.pulls, [&](std::size_t i) { return pull_corner(free, filter, path, i); });
    const bool slid = change_each(path, tried.slides, [&](std::size_t i) { return slide(free, filter, path, i); });
    if (!pulled && !slid) break;
    leave_out(free, filter, path, false, &tried);
    const double shorter = length_of(path);
    if (round > 4 && shorter > length * (1 - 1e-12)) break;
    length = shorter;
  }
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 1; i + 1 < path.size(); ++i) polish(free, filter, path, i);
  }
}

}  // namespace nef::planner

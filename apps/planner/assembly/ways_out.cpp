// SPDX-License-Identifier: Apache-2.0
//
// Begins with the parts that touch those that move. Of the paths out of their free space to six points beyond all
// boxes the one is taken that meets the fewest boxes of other parts. Those come in, until it meets none. If the moving
// parts cannot leave some, they cannot leave more.
#include "apps/planner/assembly/ways_out.h"

#include <algorithm>
#include <array>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/free_space/free_space.h"
#include "apps/planner/path/simple_points.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

PartSet united_sets(const PartSet& a, const PartSet& b) {
  PartSet result;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

}  // namespace

// Where a may be while b rests. (b, while a rests, may be at the opposite vectors.)
const Polyhedron& WaysOut::free_of_pair(std::size_t a, std::size_t b) {
  std::optional<Polyhedron>& known = free_of_pairs_[{a, b}];
  if (known) return *known;
  const auto other = free_of_pairs_.find({b, a});
  if (other != free_of_pairs_.end() && other->second) {
    known = minkowski::negate(*other->second, monitor_);
  } else {
    minkowski::MinkowskiOptions options;
    options.monitor = monitor_;
    known = minkowski::configuration_space(assembly_.parts[a], std::array{assembly_.parts[b]}, std::nullopt, options);
  }
  return *known;
}

// Where some parts may be while others rest. Solids overlap iff two of their parts do.
Polyhedron WaysOut::free_of(const PartSet& moving, const PartSet& stay) {
  std::vector<Polyhedron> sets;
  for (const std::size_t a : moving) {
    for (const std::size_t b : stay) sets.push_back(free_of_pair(a, b));
  }
  return intersect_all(sets, monitor_);
}

// Six points along the axes at which the box of what moves is beyond that of what stays, and which are on the bounds or
// beyond.
std::vector<Rational3> WaysOut::goals(const PartSet& moving, const PartSet& stay,
                                      const std::array<Rational3, 2>& bounds) const {
  const std::array<Rational3, 2> mine = blocking_.box_of(moving);
  const std::array<Rational3, 2> theirs = blocking_.box_of(stay);
  std::vector<Rational3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational up = std::max(bounds[1][i], Rational(theirs[1][i] - mine[0][i]));
    const Rational down = std::max(Rational(-bounds[0][i]), Rational(mine[1][i] - theirs[0][i]));
    Rational3 out;
    out[i] = digits_ ? rounded_up(up, *digits_) : up;
    result.push_back(out);
    out[i] = -(digits_ ? rounded_up(down, *digits_) : down);
    result.push_back(out);
  }
  return result;
}

// Of those that stay, those whose boxes meet the box of one that moves on its way.
PartSet WaysOut::met_by(const std::vector<Rational3>& path, const PartSet& moving, const PartSet& stay) const {
  PartSet result;
  for (const std::size_t b : stay) {
    const bool meets = std::any_of(moving.begin(), moving.end(), [&](std::size_t a) {
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        if (blocking_.boxes_meet_on(a, b, path[i], path[i + 1])) return true;
      }
      return false;
    });
    if (meets) result.push_back(b);
  }
  return result;
}

std::variant<ExactPath, PartSet> WaysOut::leave(const PartSet& moving, const PartSet& stay) {
  PartSet asked;
  for (const std::size_t b : stay) {
    const bool touches =
        std::any_of(moving.begin(), moving.end(), [&](std::size_t a) { return blocking_.blocks_some_beginning(a, b); });
    if (touches) asked.push_back(b);
  }
  while (true) {
    monitor_.check_interruption();
    std::optional<FreeSpace> free;
    std::array<Rational3, 2> bounds;
    if (!asked.empty()) {
      free.emplace(free_of(moving, asked));
      const CellId here = free->locate(ExactPoint(Rational3{}));
      NEF_ASSERT(free->is_free(here));
      if (free->components()[free->component(here)].bounded) return asked;
      bounds = free->bounds();
    }
    std::optional<ExactPath> best;
    PartSet met;
    for (const Rational3& out : goals(moving, stay, bounds)) {
      ExactPath path;
      if (free) {
        PathOptions options;
        options.thorough = false;
        options.digits = digits_;
        std::optional<ExactPath> found = find_path(*free, Rational3{}, out, options, monitor_);
        NEF_ASSERT(found.has_value());
        path = std::move(*found);
      } else {
        path.points = {Rational3{}, out};
        path.length = distance(path.points[0], path.points[1]);
      }
      PartSet hit = met_by(path.points, moving, without(stay, asked));
      if (best && std::pair(met.size(), best->length) <= std::pair(hit.size(), path.length)) continue;
      best = std::move(path);
      met = std::move(hit);
    }
    if (met.empty()) return std::move(*best);
    asked = united_sets(asked, met);
  }
}

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// A stack holds sets of parts that are still together. For each set, `straight_step` goes through the candidate
// directions; the minimal closed sets of the blocking graph are what can leave along a ray, and the one of fewest parts
// and smallest box is taken. Otherwise `planned_step` asks SeparationSearch, with two tests: some direction lets the
// moving parts begin, and the component of free space that contains the origin is unbounded. That free space is the
// intersection of those of pairs, each computed once. The path then leads to the nearest of six points on the bounds of
// the free space's boundary. What leaves and what stays are pushed back on the stack.
#include "apps/planner/assembly/disassembly.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "apps/minkowski/minkowski.h"
#include "apps/planner/assembly/blocking.h"
#include "apps/planner/assembly/closed_sets.h"
#include "apps/planner/free_space/free_space.h"
#include "apps/planner/path/path.h"
#include "apps/planner/path/simple_points.h"
#include "nef/base/error.h"
#include "nef/base/interruption.h"
#include "nef/geometry/integer_vector.h"
#include "nef/geometry/vectors.h"

namespace nef::planner {
namespace {

PartSet all_parts(const Assembly& assembly) {
  PartSet parts(assembly.parts.size());
  std::iota(parts.begin(), parts.end(), std::size_t{0});
  return parts;
}

class TakingApart {
 public:
  TakingApart(const Assembly& assembly, const std::optional<unsigned>& digits, const Monitor& monitor)
      : assembly_(assembly),
        digits_(digits),
        told_(monitor),
        monitor_(monitor.quiet()),
        blocking_(assembly.parts, monitor_) {}

  Disassembly run() {
    std::vector<PartSet> together{all_parts(assembly_)};
    while (!together.empty()) {
      const PartSet parts = together.back();
      together.pop_back();
      if (parts.size() < 2) continue;
      told_.tell_progress("taking apart", result_.steps.size(), assembly_.parts.size() - 1);
      proved_below_ = 1;
      std::optional<DisassemblyStep> step;
      try {
        if (directions_.empty() && !begin()) break;
        step = straight_step(parts);
        if (!step) step = planned_step(parts);
      } catch (const Interrupted&) {
        result_.undecided.push_back({parts, proved_below_});
      }
      if (!step) continue;              // stuck, or undecided
      together.push_back(step->parts);  // comes after the rest
      together.push_back(step->stay);
      result_.steps.push_back(std::move(*step));
    }
    return std::move(result_);
  }

 private:
  // Finds the directions to try; false if parts overlap.
  bool begin() {
    result_.overlap = blocking_.overlapping();
    if (result_.overlap) return false;
    const std::optional<std::vector<Rational3>> all = blocking_.directions();
    tells_all_ = all.has_value();
    directions_ = all ? *all : axes();
    return true;
  }

  static std::vector<Rational3> axes() {
    std::vector<Rational3> result;
    for (std::size_t i = 0; i < 3; ++i) {
      for (const int sign : {1, -1}) {
        Rational3 d;
        d[i] = sign;
        result.push_back(d);
      }
    }
    return result;
  }

  // Who blocks whom among some parts, by their places in the list.
  template <typename Blocks>
  static BlockingGraph graph(const PartSet& parts, const Blocks& blocks) {
    BlockingGraph graph(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t j = 0; j < parts.size(); ++j) {
        if (i != j && blocks(parts[i], parts[j])) graph[i].push_back(j);
      }
    }
    return graph;
  }

  static PartSet named(const PartSet& parts, const std::vector<std::size_t>& places) {
    PartSet result;
    for (const std::size_t i : places) result.push_back(parts[i]);
    std::sort(result.begin(), result.end());
    return result;
  }

  // The smallest set that leaves in one straight motion: of the fewest parts, then of the smallest box. (Of two sides
  // that part the smaller one moves.)
  std::optional<DisassemblyStep> straight_step(const PartSet& parts) {
    constexpr std::size_t kEnough = 26;  // with a single part found by then, the rest need not be tried
    std::optional<DisassemblyStep> best;
    std::pair<std::size_t, Rational> best_size;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      if (i >= kEnough && best && best_size.first == 1) break;
      const Rational3& d = directions_[i];
      const BlockingGraph blocked =
          graph(parts, [&](std::size_t a, std::size_t b) { return blocking_.blocks(a, b, d); });
      for (const std::vector<std::size_t>& closed : minimal_closed_sets(blocked)) {
        PartSet moving = named(parts, closed);
        if (moving.size() == parts.size()) continue;
        PartSet stay = without(parts, moving);
        Rational3 along = d;
        if (size_of(stay) < size_of(moving)) {
          std::swap(moving, stay);
          along = opposite(d);
        }
        const std::pair<std::size_t, Rational> size = size_of(moving);
        if (best && best_size <= size) continue;
        best_size = size;
        best = DisassemblyStep{moving, stay, {Rational3{}, end_of(moving, stay, along)}, true, {}};
      }
    }
    return best;
  }

  // How many parts, and the volume of the box around them.
  [[nodiscard]] std::pair<std::size_t, Rational> size_of(const PartSet& parts) const {
    const std::array<Rational3, 2> box = box_of(parts);
    Rational volume = 1;
    for (std::size_t i = 0; i < 3; ++i) volume *= box[1][i] - box[0][i];
    return {parts.size(), volume};
  }

  [[nodiscard]] std::array<Rational3, 2> box_of(const PartSet& parts) const {
    std::array<Rational3, 2> box = blocking_.box(parts.front());
    for (const std::size_t part : parts) {
      const std::array<Rational3, 2>& other = blocking_.box(part);
      for (std::size_t i = 0; i < 3; ++i) {
        box[0][i] = std::min(box[0][i], other[0][i]);
        box[1][i] = std::max(box[1][i], other[1][i]);
      }
    }
    return box;
  }

  // How far along d until the boxes are apart, by a quarter of the moving one.
  [[nodiscard]] Rational3 end_of(const PartSet& moving, const PartSet& stay, const Rational3& d) const {
    const std::array<Rational3, 2> mine = box_of(moving);
    const std::array<Rational3, 2> theirs = box_of(stay);
    std::optional<Rational> least;
    for (std::size_t i = 0; i < 3; ++i) {
      if (d[i] == 0) continue;
      const Rational gap = (mine[1][i] - mine[0][i]) / 4;
      const Rational way =
          d[i] > 0 ? Rational(theirs[1][i] - mine[0][i] + gap) : Rational(theirs[0][i] - mine[1][i] - gap);
      const Rational t = std::max(Rational(0), Rational(way / d[i]));
      if (!least || t < *least) least = t;
    }
    if (!digits_) return {*least * d[0], *least * d[1], *least * d[2]};
    // A decimal multiple of a whole vector is as rounded; a little farther does no harm.
    const Integer denominator = common_denominator(d);
    const Rational t = rounded_up(*least / denominator, *digits_) * denominator;
    return {t * d[0], t * d[1], t * d[2]};
  }

  // True if some of the parts can begin to move, the others at rest. The directions must tell all.
  bool may_begin(const PartSet& moving, const PartSet& stay) {
    return std::any_of(directions_.begin(), directions_.end(), [&](const Rational3& d) {
      return std::none_of(moving.begin(), moving.end(), [&](std::size_t a) {
        return std::any_of(stay.begin(), stay.end(), [&](std::size_t b) { return blocking_.blocks_at_once(a, b, d); });
      });
    });
  }

  // True if in every direction all parts are tied together at once.
  bool nothing_moves(const PartSet& parts) {
    return tells_all_ && std::all_of(directions_.begin(), directions_.end(), [&](const Rational3& d) {
             const auto blocks = [&](std::size_t a, std::size_t b) { return blocking_.blocks_at_once(a, b, d); };
             return minimal_closed_sets(graph(parts, blocks)).front().size() == parts.size();
           });
  }

  std::optional<DisassemblyStep> planned_step(const PartSet& parts) {
    std::vector<Separates> tests;
    if (tells_all_) {
      tests.emplace_back([this](const PartSet& moving, const PartSet& stay) { return may_begin(moving, stay); });
    }
    tests.emplace_back([this](const PartSet& moving, const PartSet& stay) {
      monitor_.check_interruption();
      return leads_out(FreeSpace(free_of(moving, stay)));
    });
    if (nothing_moves(parts)) return stuck(parts, true);
    SeparationSearch search(parts, tests);
    try {
      const std::optional<PartSet> moving = search.run();
      if (!moving) return stuck(parts, false);
      const PartSet stay = without(parts, *moving);
      ExactPath way = way_out(*moving, stay);
      return DisassemblyStep{*moving, stay, std::move(way.points), false, std::move(way.unrounded)};
    } catch (const Interrupted&) {
      proved_below_ = search.proved_below();
      throw;
    }
  }

  std::nullopt_t stuck(const PartSet& parts, bool nothing_moves) {
    Inseparable result{parts, nothing_moves, {}};
    for (const std::size_t a : parts) {
      for (const std::size_t b : parts) {
        if (a == b) continue;
        const bool in_the_way = std::any_of(directions_.begin(), directions_.end(),
                                            [&](const Rational3& d) { return blocking_.blocks(a, b, d); });
        if (in_the_way) result.blocked_by.emplace_back(a, b);
      }
    }
    result_.inseparable.push_back(std::move(result));
    return std::nullopt;
  }

  // Where a may be while b rests. (b, while a rests, may be at the opposite vectors.)
  const Polyhedron& free_of_pair(std::size_t a, std::size_t b) {
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
  Polyhedron free_of(const PartSet& moving, const PartSet& stay) {
    std::vector<Polyhedron> sets;
    for (const std::size_t a : moving) {
      for (const std::size_t b : stay) sets.push_back(free_of_pair(a, b));
    }
    return intersect_all(sets, monitor_);
  }

  // True if there is a way from where the parts are to infinity.
  static bool leads_out(const FreeSpace& free) {
    const CellId here = free.locate(ExactPoint(Rational3{}));
    NEF_ASSERT(free.is_free(here));
    return !free.components()[free.component(here)].bounded;
  }

  // A path out of the way of the others, which there must be.
  ExactPath way_out(const PartSet& moving, const PartSet& stay) {
    const FreeSpace free(free_of(moving, stay));
    // All of the boundary is inside these bounds, so whoever is on them or beyond is out.
    const std::array<Rational3, 2> bounds = free.bounds();
    const auto out_of = [&](std::size_t side, std::size_t i) {
      const Rational& bound = bounds[side][i];
      if (!digits_) return bound;
      return side == 1 ? rounded_up(bound, *digits_) : Rational(-rounded_up(-bound, *digits_));
    };
    std::optional<ExactPath> best;
    for (std::size_t i = 0; i < 3; ++i) {
      for (const std::size_t side : {0, 1}) {
        Rational3 out;
        out[i] = out_of(side, i);
        PathOptions options;
        options.thorough = false;
        options.digits = digits_;
        std::optional<ExactPath> path = find_path(free, Rational3{}, out, options, monitor_);
        NEF_ASSERT(path.has_value());
        if (!best || path->length < best->length) best = std::move(path);
      }
    }
    return std::move(*best);
  }

  const Assembly& assembly_;
  std::optional<unsigned> digits_;
  Monitor told_;  // of steps
  Monitor monitor_;
  std::size_t proved_below_ = 1;  // of the parts that are looked at
  Blocking blocking_;
  std::vector<Rational3> directions_;
  bool tells_all_ = false;  // if nothing begins to move in these directions, then in no other one
  std::map<std::pair<std::size_t, std::size_t>, std::optional<Polyhedron>> free_of_pairs_;
  Disassembly result_;
};

}  // namespace

Disassembly take_apart(const Assembly& assembly, const std::optional<unsigned>& digits, const Monitor& monitor) {
  try {
    return TakingApart(assembly, digits, monitor).run();
  } catch (const Interrupted&) {  // before anything was known
    Disassembly answer;
    answer.undecided.push_back({all_parts(assembly)});
    return answer;
  }
}

}  // namespace nef::planner

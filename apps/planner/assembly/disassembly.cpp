// SPDX-License-Identifier: Apache-2.0
//
// A stack holds sets of parts that are still together. For each set, `straight_step` looks for a straight motion: of a
// single part, smallest box first, then of the minimal closed sets of the blocking graphs of the candidate directions.
// Otherwise `planned_step` asks SeparationSearch, with two tests: the moving parts can begin, and they can leave. What
// leaves and what stays are pushed back on the stack. What does not come apart so is tried in more ways, as far as
// these are asked for: parts in different directions at once, and sets that turn. Whatever is known of some parts is
// known while they are together, whoever else is there, so cores are kept from step to step.
#include "apps/planner/assembly/disassembly.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "apps/planner/assembly/blocking.h"
#include "apps/planner/assembly/closed_sets.h"
#include "apps/planner/assembly/first_motions.h"
#include "apps/planner/assembly/simultaneous.h"
#include "apps/planner/assembly/ways_out.h"
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
  TakingApart(const Assembly& assembly, const DisassemblyOptions& options, const Monitor& monitor)
      : assembly_(assembly),
        options_(options),
        told_(monitor),
        monitor_(monitor.quiet()),
        blocking_(assembly.parts, monitor_),
        ways_out_(assembly, blocking_, options.digits, monitor_) {}

  Disassembly run() {
    std::vector<PartSet> together{all_parts(assembly_)};
    while (!together.empty()) {
      const PartSet parts = together.back();
      together.pop_back();
      if (parts.size() < 2) continue;
      told_.tell_progress("taking apart", result_.steps.size(), assembly_.parts.size() - 1);
      proved_below_ = 1;
      try {
        if (directions_.empty() && !begin()) break;
        std::optional<DisassemblyStep> step = next_step(parts);
        if (!step && options_.simultaneous) step = simultaneous_step(parts);
        all_proved_ = true;
        if (!step && assembly_.turns()) step = turning_step(parts);
        if (step) {
          for (PartSet& rest : parts_after(*step)) together.push_back(std::move(rest));
          result_.steps.push_back(std::move(*step));
        } else if (all_proved_) {
          result_.inseparable.push_back(stuck(parts));
        } else {
          result_.undecided.push_back({parts, proved_below_});
        }
      } catch (const Interrupted&) {
        result_.undecided.push_back({parts, proved_below_});
      }
    }
    for (Inseparable& stuck : result_.inseparable) find_interlocked(stuck);
    return std::move(result_);
  }

 private:
  // In which directions a part can begin to move among those that touch it.
  struct Ways {
    PartSet touching;
    std::vector<Rational3> directions;
  };

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

  // What is together after a step; what stays comes first.
  static std::vector<PartSet> parts_after(const DisassemblyStep& step) {
    if (step.vectors.empty()) return {step.parts, step.stay};  // the last one is looked at next
    std::map<Rational3, PartSet> groups;
    for (const std::size_t part : step.stay) groups[Rational3{}].push_back(part);
    for (std::size_t i = 0; i < step.parts.size(); ++i) groups[step.vectors[i]].push_back(step.parts[i]);
    std::vector<PartSet> result;
    for (auto& [vector, group] : groups) {
      std::sort(group.begin(), group.end());
      result.push_back(std::move(group));
    }
    return result;
  }

  // Nothing if no set of the parts can leave the others by translations.
  std::optional<DisassemblyStep> next_step(const PartSet& parts) {
    if (std::optional<DisassemblyStep> step = single_step(parts)) return step;
    if (tied_in_all_directions(parts)) return std::nullopt;
    if (std::optional<DisassemblyStep> step = straight_step(parts)) return step;
    return planned_step(parts);
  }

  // A single part that leaves in one straight motion, the one with the smallest box; or all others leave it.
  std::optional<DisassemblyStep> single_step(const PartSet& parts) {
    std::vector<std::pair<Rational, std::size_t>> by_size;
    for (const std::size_t part : parts) by_size.emplace_back(size_of({part}).second, part);
    std::sort(by_size.begin(), by_size.end());
    for (const auto& sized : by_size) {
      const std::size_t part = sized.second;
      monitor_.check_interruption();
      const PartSet others = without(parts, {part});
      for (const Rational3& d : ways_of(part, others)) {
        const bool leaves = std::none_of(others.begin(), others.end(),
                                         [&](std::size_t other) { return blocking_.blocks(part, other, d); });
        if (leaves) return straight({part}, others, d);
      }
    }
    return std::nullopt;
  }

  // Directions in which a part can begin to move. They change only if one leaves that touches it.
  const std::vector<Rational3>& ways_of(std::size_t part, const PartSet& others) {
    PartSet touching;
    for (const std::size_t other : others) {
      if (blocking_.blocks_some_beginning(part, other)) touching.push_back(other);
    }
    std::optional<Ways>& known = ways_[part];
    if (!known || known->touching != touching) {
      std::vector<Rational3> ways = free_ways(blocking_.blocked_cones({part}, touching), monitor_);
      known = Ways{std::move(touching), std::move(ways)};
    }
    return known->directions;
  }

  // True if the candidate directions show that no set can begin to move.
  bool tied_in_all_directions(const PartSet& parts) {
    return tells_all_ && std::all_of(directions_.begin(), directions_.end(), [&](const Rational3& d) {
             monitor_.check_interruption();
             return blocking_.are_tied_at_once(parts, d);
           });
  }

  // Who blocks whom among some parts, by their places in the list.
  BlockingGraph graph(const PartSet& parts, const Rational3& d) {
    BlockingGraph graph(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      monitor_.check_interruption();
      for (std::size_t j = 0; j < parts.size(); ++j) {
        if (i != j && blocking_.blocks(parts[i], parts[j], d)) graph[i].push_back(j);
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
      if (blocking_.are_tied_at_once(parts, d)) continue;
      for (const std::vector<std::size_t>& closed : minimal_closed_sets(graph(parts, d))) {
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
        best = straight(moving, stay, along);
      }
    }
    return best;
  }

  [[nodiscard]] DisassemblyStep straight(const PartSet& moving, const PartSet& stay, const Rational3& d) const {
    DisassemblyStep step;
    step.parts = moving;
    step.stay = stay;
    step.path = {Rational3{}, end_of(moving, stay, d)};
    step.straight = true;
    return step;
  }

  // How many parts, and the volume of the box around them.
  [[nodiscard]] std::pair<std::size_t, Rational> size_of(const PartSet& parts) const {
    const std::array<Rational3, 2> box = blocking_.box_of(parts);
    Rational volume = 1;
    for (std::size_t i = 0; i < 3; ++i) volume *= box[1][i] - box[0][i];
    return {parts.size(), volume};
  }

  // How far along d until the boxes are apart, by a quarter of the moving one.
  [[nodiscard]] Rational3 end_of(const PartSet& moving, const PartSet& stay, const Rational3& d) const {
    const std::array<Rational3, 2> mine = blocking_.box_of(moving);
    const std::array<Rational3, 2> theirs = blocking_.box_of(stay);
    std::optional<Rational> least;
    for (std::size_t i = 0; i < 3; ++i) {
      if (d[i] == 0) continue;
      const Rational gap = (mine[1][i] - mine[0][i]) / 4;
      const Rational way =
          d[i] > 0 ? Rational(theirs[1][i] - mine[0][i] + gap) : Rational(theirs[0][i] - mine[1][i] - gap);
      const Rational t = std::max(Rational(0), Rational(way / d[i]));
      if (!least || t < *least) least = t;
    }
    if (!options_.digits) return {*least * d[0], *least * d[1], *least * d[2]};
    // A decimal multiple of a whole vector is as rounded; a little farther does no harm.
    const Integer denominator = common_denominator(d);
    const Rational t = rounded_up(*least / denominator, *options_.digits) * denominator;
    return {t * d[0], t * d[1], t * d[2]};
  }

  std::optional<DisassemblyStep> planned_step(const PartSet& parts) {
    std::optional<ExactPath> way;  // of the set that was asked about last
    const std::array<HeldBy, 2> tests{[this](const PartSet& moving, const PartSet& stay) -> std::optional<Core> {
                                        if (free_cone(blocking_.blocked_cones(moving, stay), monitor_))
                                          return std::nullopt;
                                        return Core{moving, stay};
                                      },
                                      [this, &way](const PartSet& moving, const PartSet& stay) -> std::optional<Core> {
                                        std::variant<ExactPath, PartSet> found = ways_out_.leave(moving, stay);
                                        if (const PartSet* const holding = std::get_if<PartSet>(&found))
                                          return Core{moving, *holding};
                                        way = std::get<ExactPath>(std::move(found));
                                        return std::nullopt;
                                      }};
    SeparationSearch search(parts, tests, cores_);
    const auto keep = [&] { cores_.insert(cores_.end(), search.found().begin(), search.found().end()); };
    try {
      const std::optional<PartSet> moving = search.run();
      keep();
      if (!moving) return std::nullopt;
      DisassemblyStep step;
      step.parts = *moving;
      step.stay = without(parts, *moving);
      step.path = std::move(way->points);
      step.unrounded = std::move(way->unrounded);
      return step;
    } catch (const Interrupted&) {
      keep();
      proved_below_ = assembly_.turns() ? 1 : search.proved_below();
      throw;
    }
  }

  // Parts that leave each other at once, in different directions.
  std::optional<DisassemblyStep> simultaneous_step(const PartSet& parts) {
    const std::optional<std::vector<Rational3>> vectors = simultaneous_motions(blocking_, parts, monitor_);
    if (!vectors) return std::nullopt;
    const Rational end = simultaneous_end(blocking_, parts, *vectors);
    DisassemblyStep step;
    step.straight = true;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Rational3& v = (*vectors)[i];
      if (is_zero(v)) {
        step.stay.push_back(parts[i]);
        continue;
      }
      step.parts.push_back(parts[i]);
      step.vectors.push_back({end * v[0], end * v[1], end * v[2]});
    }
    return step;
  }

  // A set that leaves with turns, of the fewest parts: all sets of a number of parts are asked about, but those of
  // which it is known that parts of them do not leave others. all_proved_ becomes false if some set is neither.
  std::optional<DisassemblyStep> turning_step(const PartSet& parts) {
    constexpr std::size_t kMostUndecided = 40;  // sets; after that there is little hope
    std::size_t undecided = 0;
    for (std::size_t size = 1; 2 * size <= parts.size(); ++size) {
      proved_below_ = all_proved_ ? size : proved_below_;
      std::vector<bool> chosen(parts.size(), false);
      std::fill(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(size), true);
      do {
        if (2 * size == parts.size() && !chosen.front()) break;  // the other side has been asked about
        PartSet moving;
        for (std::size_t i = 0; i < parts.size(); ++i) {
          if (chosen[i]) moving.push_back(parts[i]);
        }
        const PartSet stay = without(parts, moving);
        if (is_ruled_out(moving, stay)) continue;
        TurningWayAnswer found = turning_way(assembly_, moving, stay, {options_.max_cells}, monitor_);
        if (found.status == TurningWayAnswer::Status::kWay) {
          DisassemblyStep step;
          step.parts = moving;
          step.stay = stay;
          for (const RigidPose& pose : found.way->poses) step.path.push_back(pose.position);
          step.turning = std::move(found.way);
          return step;
        }
        if (found.status == TurningWayAnswer::Status::kNone) {
          turning_cores_.push_back({moving, stay});
          turning_cores_.push_back({stay, moving});
          continue;
        }
        all_proved_ = false;
        if (++undecided == kMostUndecided) return std::nullopt;
      } while (std::prev_permutation(chosen.begin(), chosen.end()));
    }
    return std::nullopt;
  }

  [[nodiscard]] bool is_ruled_out(const PartSet& moving, const PartSet& stay) const {
    return std::any_of(turning_cores_.begin(), turning_cores_.end(), [&](const Core& core) {
      return std::includes(moving.begin(), moving.end(), core.moving.begin(), core.moving.end()) &&
             std::includes(stay.begin(), stay.end(), core.stay.begin(), core.stay.end());
    });
  }

  // True if no set of some parts can begin to move.
  bool nothing_moves(const PartSet& parts) {
    if (tells_all_) return tied_in_all_directions(parts);
    const std::array<HeldBy, 1> tests{[this](const PartSet& moving, const PartSet& stay) -> std::optional<Core> {
      if (free_cone(blocking_.blocked_cones(moving, stay), monitor_)) return std::nullopt;
      return Core{moving, stay};
    }};
    std::vector<Core> known;
    std::copy_if(cores_.begin(), cores_.end(), std::back_inserter(known),
                 [](const Core& core) { return core.test == 0; });
    return !SeparationSearch(parts, tests, known).run();
  }

  // What is told of parts that do not come apart.
  Inseparable stuck(const PartSet& parts) {
    Inseparable result;
    result.parts = parts;
    result.interlocked = parts;
    try {
      result.nothing_moves = !assembly_.turns() && nothing_moves(parts);
      find_blockers(result);
    } catch (const Interrupted&) {  // the answer stands without them
    }
    return result;
  }

  // Who is in the way of whom.
  void find_blockers(Inseparable& result) {
    constexpr std::size_t kEnough = 26;  // directions for pairs that do not touch
    const PartSet& parts = result.parts;
    for (const std::size_t a : parts) {
      for (const std::size_t b : parts) {
        if (a == b) continue;
        const auto end = directions_.begin() + static_cast<std::ptrdiff_t>(std::min(directions_.size(), kEnough));
        const bool in_the_way =
            blocking_.blocks_some_beginning(a, b) ||
            std::any_of(directions_.begin(), end, [&](const Rational3& d) { return blocking_.blocks(a, b, d); });
        if (in_the_way) result.blocked_by.emplace_back(a, b);
      }
    }
  }

  // Some of the parts that do not come apart; nothing if all do.
  std::optional<PartSet> rest_of(const PartSet& parts) {
    std::vector<PartSet> together{parts};
    while (!together.empty()) {
      const PartSet next = together.back();
      together.pop_back();
      if (next.size() < 2) continue;
      const std::optional<DisassemblyStep> step = next_step(next);
      if (!step) return next;
      together.push_back(step->parts);
      together.push_back(step->stay);
    }
    return std::nullopt;
  }

  // Leaves out parts as long as something of the others does not come apart.
  void find_interlocked(Inseparable& stuck) {
    if (assembly_.turns()) {  // what comes apart by translations only says too little
      stuck.interlocked_is_least = stuck.parts.size() == 2;
      return;
    }
    try {
      for (const std::size_t part : stuck.parts) {
        if (stuck.interlocked.size() == 2) break;
        if (!std::binary_search(stuck.interlocked.begin(), stuck.interlocked.end(), part)) continue;
        std::optional<PartSet> rest = rest_of(without(stuck.interlocked, {part}));
        if (rest) stuck.interlocked = std::move(*rest);
      }
    } catch (const Interrupted&) {
      stuck.interlocked_is_least = false;
    }
  }

  const Assembly& assembly_;
  DisassemblyOptions options_;
  Monitor told_;  // of steps
  Monitor monitor_;
  std::size_t proved_below_ = 1;  // of the parts that are looked at
  Blocking blocking_;
  WaysOut ways_out_;
  std::vector<Rational3> directions_;
  bool tells_all_ = false;  // if nothing begins to move in these directions, then in no other one
  std::map<std::size_t, std::optional<Ways>> ways_;  // of each part
  std::vector<Core> cores_;
  std::vector<Core> turning_cores_;  // with turns
  bool all_proved_ = true;           // of the parts that are looked at
  Disassembly result_;
};

}  // namespace

Disassembly take_apart(const Assembly& assembly, const DisassemblyOptions& options, const Monitor& monitor) {
  try {
    return TakingApart(assembly, options, monitor).run();
  } catch (const Interrupted&) {  // before anything was known
    Disassembly answer;
    answer.undecided.push_back({all_parts(assembly)});
    return answer;
  }
}

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/assembly/separation.h"

#include <algorithm>
#include <iterator>
#include <queue>
#include <utility>

#include "nef/base/error.h"

namespace nef::planner {
namespace {

PartSet with(PartSet set, std::size_t part) {
  set.insert(std::upper_bound(set.begin(), set.end(), part), part);
  return set;
}

bool holds_all(const PartSet& set, const PartSet& some) {
  return std::includes(set.begin(), set.end(), some.begin(), some.end());
}

bool holds_any(const PartSet& set, const PartSet& some) {
  return std::any_of(some.begin(), some.end(),
                     [&set](std::size_t part) { return std::binary_search(set.begin(), set.end(), part); });
}

// Sets that hold `moving` and nothing of `fixed`.
struct Branch {
  PartSet moving;
  PartSet fixed;
  // The fewest parts are looked at first, then the first ones.
  bool operator<(const Branch& other) const {
    return moving.size() != other.moving.size() ? moving.size() > other.moving.size() : moving > other.moving;
  }
};

}  // namespace

PartSet without(const PartSet& all, const PartSet& some) {
  PartSet rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
  return rest;
}

SeparationSearch::SeparationSearch(const PartSet& parts, std::span<const HeldBy> tests, std::span<const Core> known)
    : parts_(parts), tests_(tests) {
  for (const Core& core : known) {
    if (holds_all(parts_, core.moving) && holds_all(parts_, core.stay)) cores_.push_back(core);
  }
  known_ = cores_.size();
}

std::optional<Core> SeparationSearch::ask(std::size_t test, const PartSet& moving, const PartSet& stay) {
  ++questions_;
  std::optional<Core> held = tests_[test](moving, stay);
  if (held) held->test = test;
  return held;
}

// Leaves out of one side of a core whatever can be left out, larger runs first.
void SeparationSearch::shrink(Core& core, PartSet Core::*side) {
  for (std::size_t run = ((core.*side).size() + 1) / 2; run > 0; run = run > 1 ? (run + 1) / 2 : 0) {
    for (std::size_t begin = 0; begin < (core.*side).size() && (core.*side).size() > 1;) {
      Core fewer = core;
      PartSet& rest = fewer.*side;
      const auto first = rest.begin() + static_cast<std::ptrdiff_t>(begin);
      rest.erase(first, first + static_cast<std::ptrdiff_t>(std::min(run, rest.size() - begin)));
      std::optional<Core> held;
      if (!rest.empty()) held = ask(core.test, fewer.moving, fewer.stay);
      if (held) {
        core = std::move(*held);
      } else {
        begin += run;
      }
    }
  }
}

void SeparationSearch::learn(Core core) {
  shrink(core, &Core::stay);
  shrink(core, &Core::moving);
  cores_.push_back(core);
  std::swap(core.moving, core.stay);
  cores_.push_back(std::move(core));
}

bool SeparationSearch::separates(const PartSet& moving) {
  const PartSet stay = without(parts_, moving);
  for (std::size_t test = 0; test < tests_.size(); ++test) {
    std::optional<Core> held = ask(test, moving, stay);
    if (!held) continue;
    learn(std::move(*held));
    return false;
  }
  return true;
}

// Of the cores that forbid `moving` to leave alone the fewest parts of which one has to come along; nothing if no core
// does.
std::optional<PartSet> SeparationSearch::parts_wanted(const PartSet& moving, const PartSet& fixed) const {
  std::optional<PartSet> fewest;
  for (const Core& core : cores_) {
    if (!holds_all(moving, core.moving) || holds_any(moving, core.stay)) continue;
    PartSet wanted = without(core.stay, fixed);
    if (!fewest || wanted.size() < fewest->size()) fewest = std::move(wanted);
  }
  return fewest;
}

std::optional<PartSet> SeparationSearch::run() {
  NEF_ASSERT(parts_.size() > 1);
  // Of two sides one has at most half of the parts. It is looked for from its first part.
  std::priority_queue<Branch> branches;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    branches.push({{parts_[i]}, PartSet(parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(i))});
  }
  while (!branches.empty()) {
    const Branch branch = branches.top();
    branches.pop();
    proved_below_ = branch.moving.size();
    std::optional<PartSet> wanted = parts_wanted(branch.moving, branch.fixed);
    if (!wanted) {
      if (separates(branch.moving)) return branch.moving;
      wanted = parts_wanted(branch.moving, branch.fixed);
    }
    if (2 * (branch.moving.size() + 1) > parts_.size()) continue;
    PartSet fixed = branch.fixed;
    for (const std::size_t part : *wanted) {
      branches.push({with(branch.moving, part), fixed});
      fixed = with(std::move(fixed), part);
    }
  }
  proved_below_ = parts_.size();
  return std::nullopt;
}

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// How some parts of an assembly leave others by translations, along any path.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "apps/planner/assembly/blocking.h"
#include "apps/planner/assembly/parts.h"
#include "apps/planner/assembly/separation.h"
#include "apps/planner/path/path.h"
#include "nef/base/monitor.h"

namespace nef::planner {

/// Exact free spaces of parts among others. The free positions of a set are those that all pairs of one moving and one
/// resting part have in common, so there is one sum for each pair, made when it is needed, and kept. An object belongs
/// to one thread.
class WaysOut {
 public:
  /// All of them must outlive it; the parts must not overlap. Way-points have at most so many decimals where that is
  /// free, ends always.
  WaysOut(const Assembly& assembly, Blocking& blocking, const std::optional<unsigned>& digits, const Monitor& monitor)
      : assembly_(assembly), blocking_(blocking), digits_(digits), monitor_(monitor) {}

  /// A path after which the box of `moving` is beyond that of `stay`; or else some of those that stay which hold it.
  /// Exact and complete. Only parts that touch `moving` are asked about, and those whose boxes a path meets that these
  /// leave free. Both sets must have parts.
  std::variant<ExactPath, PartSet> leave(const PartSet& moving, const PartSet& stay);

 private:
  const Polyhedron& free_of_pair(std::size_t a, std::size_t b);
  Polyhedron free_of(const PartSet& moving, const PartSet& stay);
  [[nodiscard]] std::vector<Rational3> goals(const PartSet& moving, const PartSet& stay,
                                             const std::array<Rational3, 2>& bounds) const;
  [[nodiscard]] PartSet met_by(const std::vector<Rational3>& path, const PartSet& moving, const PartSet& stay) const;

  const Assembly& assembly_;
  Blocking& blocking_;
  std::optional<unsigned> digits_;
  Monitor monitor_;
  std::map<std::pair<std::size_t, std::size_t>, std::optional<Polyhedron>> free_of_pairs_;
};

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// A set, and what all its sums by convolution have in common.
#pragma once

#include <optional>

#include "apps/minkowski/convolution/facets/solid_features.h"
#include "apps/minkowski/convolution/marks/interlock.h"
#include "nef/base/monitor.h"
#include "nef/polyhedron.h"

namespace nef::minkowski {

/// What a sum needs to know of one of its sets alone: a robot that is summed with many obstacles is prepared once.
/// Each part is made when it is first asked for, so the object must not be shared between threads.
class Summand {
 public:
  /// Keeps a copy of the set, which is O(1). The other members require that it is bounded and not empty, and that its
  /// boundary bounds it, or that it is closed (SolidFeatures).
  explicit Summand(const Polyhedron& set) : set_(set) {}
  ~Summand() = default;
  Summand(const Summand&) = delete;
  Summand& operator=(const Summand&) = delete;
  Summand(Summand&&) = delete;
  Summand& operator=(Summand&&) = delete;

  [[nodiscard]] const Polyhedron& set() const { return set_; }
  /// The set with points, segments and facets that are missing inside: they change no sum of sets that lie in the
  /// closures of their interiors (see minkowski_sum.cpp). What follows is of that. A union, if something is missing.
  const Polyhedron& filled(const Monitor& monitor);
  /// The points -x of all x in that. O(n).
  const Polyhedron& turned(const Monitor& monitor);
  /// O(n), and what triangulations of facets take.
  const SolidFeatures& features(const Monitor& monitor);
  /// O(n d^3) for vertices of degree d. Each edge must have one wedge.
  const Saddles& saddles(const Monitor& monitor);
  /// O(n): nef::minkowski::is_convex of the set as it was given, and of the closure of the filled one.
  bool is_convex(const Monitor& monitor);
  bool has_convex_closure(const Monitor& monitor);

 private:
  Polyhedron set_;
  std::optional<Polyhedron> filled_, turned_;
  std::optional<SolidFeatures> features_;
  std::optional<Saddles> saddles_;
  std::optional<bool> is_convex_, has_convex_closure_;
};

}  // namespace nef::minkowski

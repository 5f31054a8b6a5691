// SPDX-License-Identifier: Apache-2.0
//
// The Boolean operations as operators, as CGAL's Nef_polyhedron_3 has them. Sets are compared by equal(a, b): two
// complexes of the same set need not be the same object, and == that costs a Boolean operation would surprise.
//
// + and - of a small set and a large one wait until somebody looks at the result (Polyhedron::waiting), so a loop of
// them costs about as much as one operation with the union of the small sets.
#pragma once

#include <optional>
#include <utility>

#include "nef/polyhedron.h"

namespace nef {

inline Polyhedron operator+(const Polyhedron& a, const Polyhedron& b) {
  std::optional<Polyhedron> waiting = Polyhedron::waiting(Polyhedron::Step::kUnite, a, b);
  return waiting ? *std::move(waiting) : unite(a, b);
}
inline Polyhedron operator*(const Polyhedron& a, const Polyhedron& b) { return intersect(a, b); }
inline Polyhedron operator-(const Polyhedron& a, const Polyhedron& b) {
  std::optional<Polyhedron> waiting = Polyhedron::waiting(Polyhedron::Step::kSubtract, a, b);
  return waiting ? *std::move(waiting) : subtract(a, b);
}
inline Polyhedron operator^(const Polyhedron& a, const Polyhedron& b) { return symmetric_difference(a, b); }
inline Polyhedron operator!(const Polyhedron& a) { return complement(a); }

inline Polyhedron& operator+=(Polyhedron& a, const Polyhedron& b) { return a = a + b; }
inline Polyhedron& operator*=(Polyhedron& a, const Polyhedron& b) { return a = a * b; }
inline Polyhedron& operator-=(Polyhedron& a, const Polyhedron& b) { return a = a - b; }
inline Polyhedron& operator^=(Polyhedron& a, const Polyhedron& b) { return a = a ^ b; }

}  // namespace nef

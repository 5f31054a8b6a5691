// SPDX-License-Identifier: Apache-2.0
//
// The Boolean operations as operators, as CGAL's Nef_polyhedron_3 has them. Sets are compared by equal(a, b): two
// complexes of the same set need not be the same object, and == that costs a Boolean operation would surprise.
#pragma once

#include "nef/polyhedron.h"

namespace nef {

inline Polyhedron operator+(const Polyhedron& a, const Polyhedron& b) { return unite(a, b); }
inline Polyhedron operator*(const Polyhedron& a, const Polyhedron& b) { return intersect(a, b); }
inline Polyhedron operator-(const Polyhedron& a, const Polyhedron& b) { return subtract(a, b); }
inline Polyhedron operator^(const Polyhedron& a, const Polyhedron& b) { return symmetric_difference(a, b); }
inline Polyhedron operator!(const Polyhedron& a) { return complement(a); }

inline Polyhedron& operator+=(Polyhedron& a, const Polyhedron& b) { return a = unite(a, b); }
inline Polyhedron& operator*=(Polyhedron& a, const Polyhedron& b) { return a = intersect(a, b); }
inline Polyhedron& operator-=(Polyhedron& a, const Polyhedron& b) { return a = subtract(a, b); }
inline Polyhedron& operator^=(Polyhedron& a, const Polyhedron& b) { return a = symmetric_difference(a, b); }

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
//
// Exact measures of the set that a synthesized complex stands for; nef/polyhedron.h has the same
// for polyhedra. All are O(number of items), and near-linear in the size of the numbers.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "nef/base/monitor.h"
#include "nef/complex/complex.h"
#include "nef/number/number.h"

namespace nef {

struct Counts;

/// The volume of the set; nothing if it is infinite.
std::optional<Rational> volume(const Complex& complex);

/// The area of all facets, each once, within a few units in the last place; infinite if one is
/// unbounded.
double surface_area(const Complex& complex);

/// Smallest and largest coordinates of the finite vertices; nothing if there are none.
std::optional<std::array<Rational3, 2>> bounding_box(const Complex& complex, const Monitor& monitor);

/// V - E + F of each shell that counts() counts, as a point set, in the order of complex.shells: each vertex, edge and
/// facet counts once however often the shell passes it, and a facet with h holes and i isolated vertices counts
/// 1 - h - i. Items of an infimaximal box do not count: a half-space has two shells, of 1 each.
std::vector<long> euler_numbers(const Complex& complex);

/// The genus of each of these shells that is a closed surface, manifold at each of its vertices (the number of its
/// handles), in the same order; nothing for other shells and for those that reach an infimaximal box.
std::vector<std::optional<long>> genera(const Complex& complex);

/// How many items there are, without those of an infimaximal box: vertices, edges and facets on
/// it, the volume beyond it, and shells made of nothing else.
Counts counts(const Complex& complex);

}  // namespace nef

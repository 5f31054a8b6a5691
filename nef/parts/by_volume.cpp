// SPDX-License-Identifier: Apache-2.0
#include "nef/parts/by_volume.h"

#include <cmath>
#include <utility>

#include "nef/query/measure.h"
#include "nef/query/measures/approximate_volume.h"

namespace nef {
namespace {

// Whether the volume is above the bound; true if it is infinite.
bool is_above(const Polyhedron& set, const MeasuredVolume& measured, const Rational& bound) {
  if (std::isinf(measured.value)) return true;
  // Bounds that overflow decide nothing.
  if (std::isfinite(measured.value) && std::isfinite(measured.error)) {
    const Rational distance = Rational(measured.value) - bound;
    if (abs(distance) > Rational(measured.error)) return distance > 0;
  }
  const std::optional<Rational> exact = volume(set.complex());
  return !exact || *exact > bound;
}

bool is_larger(const Polyhedron& a, const MeasuredVolume& of_a, const Polyhedron& b, const MeasuredVolume& of_b) {
  if (std::isinf(of_b.value)) return false;
  if (std::isinf(of_a.value)) return true;
  if (std::isfinite(of_a.error) && std::isfinite(of_b.error)) {
    const Rational distance = Rational(of_a.value) - Rational(of_b.value);
    if (abs(distance) > Rational(of_a.error) + Rational(of_b.error)) return distance > 0;
  }
  const std::optional<Rational> exact = volume(b.complex());
  return exact && is_above(a, of_a, *exact);
}

}  // namespace

std::size_t largest_piece(std::span<const Polyhedron> pieces, const Monitor& monitor) {
  std::size_t best = 0;
  MeasuredVolume most = approximate_volume(pieces[0], monitor);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const MeasuredVolume measured = approximate_volume(pieces[i], monitor);
    if (!is_larger(pieces[i], measured, pieces[best], most)) continue;
    best = i;
    most = measured;
  }
  return best;
}

std::vector<Polyhedron> pieces_above(std::vector<Polyhedron> pieces, const Rational& bound, const Monitor& monitor) {
  std::vector<Polyhedron> result;
  for (Polyhedron& piece : pieces) {
    if (is_above(piece, approximate_volume(piece, monitor), bound)) result.push_back(std::move(piece));
  }
  return result;
}

}  // namespace nef

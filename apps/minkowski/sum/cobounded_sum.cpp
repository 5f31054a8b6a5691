// SPDX-License-Identifier: Apache-2.0
#include "apps/minkowski/sum/cobounded_sum.h"

#include <algorithm>
#include <array>

#include "nef/base/error.h"
#include "nef/construct/construct.h"
#include "nef/number/floor.h"

namespace nef::minkowski {
namespace {

using Corners = std::array<Rational3, 2>;

// A box that holds the given one in its inside, with coordinates that are short numbers.
Corners roomy(const Corners& box) {
  Rational extent;
  for (std::size_t i = 0; i < 3; ++i) extent = std::max(extent, Rational(box[1][i] - box[0][i]));
  // A power of two between about an eighth and a quarter of the extent.
  Rational step = 1;
  while (step * 8 < extent) step *= 2;
  while (sgn(extent) > 0 && step * 4 > extent) step /= 2;
  Corners result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[0][i] = step * (floor_of(Rational(box[0][i] / step)) - 1);
    result[1][i] = step * (floor_of(Rational(box[1][i] / step)) + 2);
  }
  return result;
}

}  // namespace

bool is_cobounded(const Polyhedron& a) { return a.complex().volumes[kOuterVolume].mark == 1; }

NearHoles near_holes(const Polyhedron& a, const Polyhedron& b, const Monitor& monitor) {
  const std::optional<Corners> holes = bounding_box(complement(a), monitor);
  const std::optional<Corners> reach = bounding_box(b, monitor);
  NEF_ASSERT(holes && reach);
  // What the sum misses lies within holes + b for each point b of B. Around that, everything belongs to it.
  Corners missed;
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < 3; ++i) missed[k][i] = (*holes)[k][i] + (*reach)[k][i];
  }
  missed = roomy(missed);
  // Of A, no point counts there but those in missed - B.
  Corners near;
  for (std::size_t i = 0; i < 3; ++i) {
    near[0][i] = missed[0][i] - (*reach)[1][i];
    near[1][i] = missed[1][i] - (*reach)[0][i];
  }
  near = roomy(near);
  // Open with open, closed with closed: the cut must not bring marks that the sum of two solids would have to look at.
  const Polyhedron box = make_box(near[0], near[1], monitor);
  return {intersect(a, a.is_open() ? interior(box, monitor) : box, monitor),
          complement(make_box(missed[0], missed[1], monitor))};
}

}  // namespace nef::minkowski

// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/recenter.h"

#include <algorithm>
#include <cmath>

#include "nef/geometry/vectors.h"
#include "nef/number/floor.h"

namespace nef {

Rational3 middle_of_few_digits(std::span<const Rational3> points) {
  Rational3 middle;
  if (points.empty()) return middle;
  Rational3 low = points.front();
  Rational3 high = low;
  Rational size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const Rational3& p : points) {
      if (p[i] < low[i]) low[i] = p[i];
      if (p[i] > high[i]) high[i] = p[i];
    }
    size = std::max(size, Rational(high[i] - low[i]));
  }
  Rational step = 1;
  while (step < size) step *= 2;
  while (size > 0 && step / 2 >= size) step /= 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational steps = (low[i] + high[i]) / (2 * step) + Rational(1, 2);
    const double rounded = nearest_double(step * Rational(floor_of(steps)));
    if (std::isfinite(rounded)) middle[i] = exact_rational(rounded);
  }
  return middle;
}

Rational3 recenter(Mesh& mesh) {
  Rational3 middle = middle_of_few_digits(mesh.vertices);
  for (Rational3& p : mesh.vertices) p = minus(p, middle);
  return middle;
}

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
#include "nef/export/nearest_float.h"

#include <cmath>
#include <limits>

namespace nef {

float nearest_float(const Rational& value) {
  const double d = nearest_double(value);
  const auto f = static_cast<float>(d);
  if (!std::isfinite(f)) return f;
  // Rounding twice errs only where the double is exactly between two floats and the value is not.
  const double rest = d - static_cast<double>(f);
  if (rest == 0 || !std::isfinite(d)) return f;
  const float g =
      std::nextafter(f, rest > 0 ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity());
  if (!std::isfinite(g) || static_cast<double>(g) - d != rest) return f;
  const int order = cmp(value, exact_rational(d));
  if (order == 0) return f;
  return (order > 0) == (g > f) ? g : f;
}

}  // namespace nef

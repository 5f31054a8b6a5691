// SPDX-License-Identifier: Apache-2.0
#include "nef/mesh/polygon/perturbed_turn.h"

namespace nef {

int perturbed_turn(const Rational3& a, const Rational3& b, const Rational3& p, std::size_t axis) {
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const Rational du = b[u] - a[u];
  const Rational dv = b[v] - a[v];
  const int sign = sgn(Rational(du * (p[v] - a[v]) - dv * (p[u] - a[u])));
  if (sign != 0) return sign;
  return sgn(dv) != 0 ? -sgn(dv) : sgn(du);
}

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nef/number/number.h"

namespace nef {

/// The sign of (b - a) x (p - a) along `axis` for p moved by (e, e^2) along the two other axes, with e > 0 as small as
/// need be (symbolic perturbation after Edelsbrunner and Muecke). It is never 0 for a and b that differ in the
/// projection.
int perturbed_turn(const Rational3& a, const Rational3& b, const Rational3& p, std::size_t axis);

}  // namespace nef

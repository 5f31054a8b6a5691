// SPDX-License-Identifier: Apache-2.0
//
// The switch of filters.
#pragma once

#include <limits>

#include "nef/base/fast_path.h"
#include "nef/number/approximation.h"

namespace nef {

/// What a filter found; with fast paths off, an approximation that tells nothing, so that the exact twin is asked.
/// Every filter of a predicate hands its result through here.
inline Approximation filtered(const Approximation& found) {
  return kFastPaths ? found : Approximation{found.value, std::numeric_limits<double>::infinity()};
}

}  // namespace nef

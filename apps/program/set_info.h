// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/number/number.h"

namespace nef {

struct SetInfoOptions {
  bool exact = false;    ///< exact numbers however long they are, and however long it takes to find them
  bool bounds = false;   ///< doubles with bounds, even where exact numbers are short; not with `exact`
  bool moments = false;  ///< the centroid and the moments of inertia, too
};

/// Exact numbers of more characters than this are null unless they are asked for.
inline constexpr std::size_t kShortNumber = 100;

/// Everything that `nef info` tells about a set: counts, properties, measures. Numbers that are infinite, undefined,
/// too long or not wanted are null.
///
/// Measures are exact if options.exact says so, and for small sets with short coordinates (has_short_measures), where
/// `volume_digits` says how many digits the volume has (numerator and denominator together). Otherwise they are doubles
/// with proven bounds: `volume_error`, `area_error`, `centroid_error` and `inertia_error` (of each coordinate or
/// entry), found in O(n).
nlohmann::ordered_json set_info(const Polyhedron& set, const SetInfoOptions& options = {}, const Monitor& monitor = {});

/// True if exact measures cost about as much as the other things that set_info tells: few corners of facets, and a
/// common denominator of all coordinates, which their numerators are not much longer than, of two words at most.
bool has_short_measures(const Polyhedron& set);

/// The members that tell of a volume, which may be infinite, and of a box, which may not be there.
void add_volume(nlohmann::ordered_json& info, const std::optional<Rational>& content, const SetInfoOptions& options);
void add_box(nlohmann::ordered_json& info, const std::optional<std::array<Rational3, 2>>& box,
             const SetInfoOptions& options);

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "nef/base/monitor.h"
#include "nef/forward.h"
#include "nef/number/number.h"

namespace nef {

struct SetInfoOptions {
  bool volume = true;    ///< compute the exact volume, which with long coordinates takes longer than all the rest
  bool exact = false;    ///< exact numbers however long they are, instead of those of kShortNumber characters at most
  bool moments = false;  ///< the centroid and the moments of inertia, too
};

/// Exact numbers of more characters than this are null unless they are asked for.
inline constexpr std::size_t kShortNumber = 100;

/// Everything that `nef info` tells about a set: counts, properties, measures. Numbers that are infinite, undefined,
/// too long or not wanted are null. Where the exact volume is not wanted, `volume_double` and `area` are
/// off by at most `volume_error` and `area_error`. `volume_digits` says how many digits the exact volume has (numerator
/// and denominator together).
nlohmann::ordered_json set_info(const Polyhedron& set, const SetInfoOptions& options = {}, const Monitor& monitor = {});

/// The members that tell of a volume, which may be infinite, and of a box, which may not be there.
void add_volume(nlohmann::ordered_json& info, const std::optional<Rational>& content, const SetInfoOptions& options);
void add_box(nlohmann::ordered_json& info, const std::optional<std::array<Rational3, 2>>& box,
             const SetInfoOptions& options);

}  // namespace nef

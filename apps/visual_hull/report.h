// SPDX-License-Identifier: Apache-2.0
//
// What a run says about itself.
#pragma once

#include <nlohmann/json.hpp>

#include "apps/visual_hull/visual_hull.h"
#include "nef/construct/construct.h"

namespace visual_hull {

/// The report of a run as JSON: `views` (contours, holes, vertices, cone facets), `phases` (seconds and
/// predicates), `result` (the keys of `nef info --json`, and the Euler number of each shell),
/// `verify` if it was done, `box`, `predicates`, `peak_memory_bytes`, and `messages` (what an output does not hold) if
/// there are any.
nlohmann::ordered_json make_report(const Result& result, const nef::Messages& messages = {});

/// The volume of a bounded hull in double precision, for people: the exact one of a detailed hull takes longer than the
/// hull itself and has millions of digits. O(n).
double approximate_volume(const nef::Polyhedron& hull);

/// One line about the hull, for people.
std::string summary(const Result& result);

/// Peak resident memory of the process in bytes.
std::size_t peak_memory();

}  // namespace visual_hull

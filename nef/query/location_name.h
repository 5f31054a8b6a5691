// SPDX-License-Identifier: Apache-2.0
//
// What holds a point, in a word.
#pragma once

#include <string_view>

#include "nef/polyhedron.h"

namespace nef {

/// "vertex", "edge", "facet" or "volume": how JSON output and Python spell a kind of location.
std::string_view location_name(Location::Kind kind);

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "nef/polyhedron.h"

namespace nef {

/// Everything that `nef info` tells about a set: counts, properties, exact measures. Numbers that are infinite or
/// undefined are null, and so are those of the volume unless it is wanted: the exact volume of a set with long
/// coordinates takes longer than all the rest.
nlohmann::ordered_json set_info(const Polyhedron& set, bool with_volume);

}  // namespace nef

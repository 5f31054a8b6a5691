// SPDX-License-Identifier: Apache-2.0
//
// What a page tells of one item, for scenes that were sent without details.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "nef/polyhedron.h"

namespace nef::view {

/// {"points": "x y z" of each of these vertices of the complex, "plane": "a b c d" of the facet, "spheres": the arrays
/// of page scenes for the vertices}. Throws InputError for an item that the set does not have.
nlohmann::json item_details(const Polyhedron& set, std::span<const std::uint32_t> vertices,
                            std::optional<std::uint32_t> facet);

}  // namespace nef::view

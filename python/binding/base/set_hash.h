// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "nef/polyhedron.h"

namespace nef::python {

/// Equal for equal sets, whatever the order of their items: from counts and from exact vertices and their marks.
/// O(number of vertices).
std::int64_t set_hash(const Polyhedron& set);

}  // namespace nef::python

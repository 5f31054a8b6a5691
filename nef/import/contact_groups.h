// SPDX-License-Identifier: Apache-2.0
//
// The faces of a mesh in groups that can be built without an arrangement.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/mesh/surface/surface_contacts.h"

namespace nef {

/// Puts each face into the first group in which no face is in contact with it; nearly all come to be in the first one.
/// A face is left out if left_out[face]. Groups and faces in them are in order. O(faces + contacts).
std::vector<std::vector<std::uint32_t>> contact_groups(std::span<const FaceContact> contacts,
                                                       const std::vector<bool>& left_out);

}  // namespace nef

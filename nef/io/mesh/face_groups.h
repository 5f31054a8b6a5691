// SPDX-License-Identifier: Apache-2.0
//
// Faces of a mesh in named groups: where each comes from, what it is made of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nef {

/// A partition of the faces of a mesh.
struct FaceGroups {
  std::vector<std::string> names;
  std::vector<std::uint32_t> of_face;  ///< index into names, for each face of the mesh

  /// True if the faces are in no groups at all.
  [[nodiscard]] bool none() const { return names.empty(); }
};

/// Red, green and blue of a group, for formats that have colours instead of names: the first dozen are easy to tell
/// apart, and so are neighbours among all.
std::array<std::uint8_t, 3> group_color(std::size_t group);

/// The light that a channel of a colour in sRGB stands for, from 0 to 1, as glTF wants it [IEC 61966-2-1].
double linear_light(std::uint8_t channel);

/// A name without white space or characters that end a word or a line in some format; "_" instead of these.
std::string group_word(const std::string& name);

/// The faces of each group, in their order.
std::vector<std::vector<std::uint32_t>> faces_by_group(const FaceGroups& groups);

}  // namespace nef

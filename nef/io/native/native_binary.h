// SPDX-License-Identifier: Apache-2.0
//
// The binary form of .nef: a complex as it is, with the links that synthesis made, in columns of little-endian
// integers.
//
//   8 bytes                 89 6e 65 66 0d 0a 1a 0a: what a transfer as text would spoil
//   u32                     version of the form, 1
//   u32 w                   bytes of an index within a vertex: 1, 2 or 4; its greatest value stands for none
//   u32[12]                 numbers of planes, vertices, svertices, shalfedges, sloops, sfaces, entries,
//                           facets, cycles, isolated vertices, shells, volumes
//   planes, points          each i32[5 or 7 per row] limbs of a number, negative like it; u64 limbs in all; u64[] limbs
//   vertices                w svertices, w pairs of shalfedges, w pairs of sloops, w sfaces, u16 mark
//   svertices               u32 p, u32 q, w out, w sface, u16 mark
//   shalfedges              u32 plane and u16 mark of each pair; w source, w next, w sface of each
//   sloops                  u32 plane and u16 mark of each pair; w sface of each
//   sfaces                  w entries, u16 mark
//   entries                 u8 kind (0 cycle, 1 svertex, 2 sloop), w index
//   twins                   u32 of each svertex
//   cycles, corners         u32 length of each cycle; u32 of each corner
//   facets                  u32 cycles, u32 isolated vertices
//   isolated vertices       u32
//   shells                  u32 of each sface; u32 volume of each shell
//   volumes                 u16 mark
//   u64                     XXH3 of all bytes before
//
// Every field above is a column of its own, in that order. A plane is twice its row, plus one if seen from its other
// side. Planes, points and links are what nef/complex/complex.h says; what follows from them is not stored.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "nef/base/monitor.h"
#include "nef/forward.h"

namespace nef {

inline constexpr std::string_view kNativeMagic = "\x89nef\r\n\x1a\n";
inline constexpr std::uint32_t kNativeBinaryVersion = 1;

/// What a file holds.
enum class NativeContents : std::uint8_t {
  kSet,  ///< a set: what is marked kOutside lies beyond an infimaximal box
  kTile  ///< the part of a set in a box (docs/tiles.md): what is marked kOutside lies beyond that
};

/// The polyhedron in this form. O(n).
std::string native_binary(const Polyhedron& polyhedron);

/// True if the bytes begin like this form.
bool is_native_binary(std::string_view bytes);

/// Reads it back; `path` is for error messages only. A file of which any byte was damaged is refused by its checksum.
/// One that somebody has made up is refused if an index or a link is wrong, so that no operation on the result leaves
/// its arrays; that its planes and points fit together is asked by nef::validate only. Throws FileError. O(n).
Polyhedron read_native_binary(std::string_view bytes, const std::string& path,
                              NativeContents contents = NativeContents::kSet, const Monitor& monitor = {});

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
//
// What becomes of a mesh that crosses itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace nef {

/// Which points belong to the solid of a mesh whose faces cross or overlap. The winding number of a point is how often
/// the faces go around it counterclockwise as seen from outside: 0 far away, 1 inside a box, 2 where two boxes overlap,
/// -1 inside a box that is inside out.
enum class Crossings : std::uint8_t {
  kRefuse,   ///< the mesh is an error unless all winding numbers are 0 and 1
  kUnion,    ///< points whose winding number is positive: what is enclosed at least once
  kNonzero,  ///< points whose winding number is not 0: parts that are inside out count, too
  kOdd,      ///< points whose winding number is odd: overlaps become cavities. Faces may be turned in any way
  kOutside,  ///< points that cannot be reached from far away without crossing a face. Faces may be turned in any way
  kGuess,    ///< of what cannot be reached from far away, the parts around which the faces wind by at least half on
             ///< average, by winding numbers for open surfaces. For soups and sheets with holes; a guess
};

/// All rules, in the order above.
inline constexpr std::array kAllCrossings{Crossings::kRefuse, Crossings::kUnion,   Crossings::kNonzero,
                                          Crossings::kOdd,    Crossings::kOutside, Crossings::kGuess};

/// The name as options spell it: refuse, union, nonzero, odd, outside, guess.
const char* name(Crossings rule);

/// The rule of that name, if there is one.
std::optional<Crossings> crossings_of_name(std::string_view name);

/// Whether a point of this winding number belongs to the solid. By kOdd, kOutside and kGuess, whose winding numbers are
/// not counted, winding numbers are 0 and 1.
bool is_taken(Crossings rule, int winding);

/// What a rule takes, as a message says it: "what is enclosed at least once".
const char* taken_by(Crossings rule);

/// "81 pairs of faces cross", or "1 pair of faces crosses".
std::string crossing_text(std::size_t pairs);

}  // namespace nef

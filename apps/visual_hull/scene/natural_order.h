// SPDX-License-Identifier: Apache-2.0
//
// The order of names that hold numbers.
#pragma once

#include <string_view>

namespace nef::visual_hull {

/// Whether `a` comes before `b`: runs of decimal digits are compared as numbers of any length, all else byte by byte,
/// so img2 comes before img10. Of names that differ in leading zeros only, the one with more zeros at the first
/// difference comes first. A strict total order: names that are not equal are never tied. O(length).
bool naturally_before(std::string_view a, std::string_view b);

}  // namespace nef::visual_hull

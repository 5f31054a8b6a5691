// SPDX-License-Identifier: Apache-2.0
//
// Suggestions for misspelt words: "; did you mean 'union'?".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nef {

/// The number of insertions, deletions, substitutions and swaps of neighbours that turn a word into another
/// (optimal string alignment). O(|a| |b|).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "; did you mean 'WORD'?" with the candidate nearest to `word` (the first of several), or an empty text if more
/// than a third of the letters, and more than one, would have to change.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace nef

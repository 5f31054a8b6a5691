// SPDX-License-Identifier: Apache-2.0
//
// Words as a list in a sentence.
#pragma once

#include <iterator>
#include <string>

namespace nef {

/// "a", "a or b", "a, b or c"; empty for no words.
template <typename Words>
std::string word_list(const Words& words, const std::string& conjunction) {
  std::string text;
  std::size_t left = std::size(words);
  for (const auto& word : words) {
    if (!text.empty()) text += left == 1 ? " " + conjunction + " " : ", ";
    text += word;
    --left;
  }
  return text;
}

}  // namespace nef

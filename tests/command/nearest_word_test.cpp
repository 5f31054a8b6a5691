// SPDX-License-Identifier: Apache-2.0
//
// apps/program/nearest_word: distances counted by hand, and by a search of all single edits.
#include "apps/program/nearest_word.h"

#include <rapidcheck/catch.h>
#include <catch2/catch.hpp>

#include <set>

namespace nef::test {
namespace {

// All words that one edit makes of a word, over the letters a and b.
std::set<std::string> edited(const std::string& word) {
  std::set<std::string> result;
  for (std::size_t i = 0; i <= word.size(); ++i) {
    for (const char c : {'a', 'b'}) {
      result.insert(word.substr(0, i) + c + word.substr(i));
      if (i < word.size()) result.insert(word.substr(0, i) + c + word.substr(i + 1));
    }
    if (i < word.size()) result.insert(word.substr(0, i) + word.substr(i + 1));
    if (i + 1 < word.size()) result.insert(word.substr(0, i) + word[i + 1] + word[i] + word.substr(i + 2));
  }
  return result;
}

}  // namespace

TEST_CASE("edit distances of words") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("union", "union") == 0);
  CHECK(edit_distance("unoin", "union") == 1);
  CHECK(edit_distance("diference", "difference") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("words at distance one are those that one edit makes") {
  rc::prop("for words of two letters", [] {
    const auto letters = rc::gen::elementOf(std::string("ab"));
    const auto word = *rc::gen::resize(6, rc::gen::container<std::string>(letters));
    const auto other = *rc::gen::resize(6, rc::gen::container<std::string>(letters));
    RC_ASSERT((edit_distance(word, other) <= 1) == (word == other || edited(word).contains(other)));
    RC_ASSERT(edit_distance(word, other) == edit_distance(other, word));
  });
}

TEST_CASE("suggestions are near words only") {
  const std::vector<std::string> known{"union", "intersection", "info"};
  CHECK(did_you_mean("unoin", known) == "; did you mean 'union'?");
  CHECK(did_you_mean("intersect", known) == "; did you mean 'intersection'?");
  CHECK(did_you_mean("inf", known) == "; did you mean 'info'?");
  CHECK(did_you_mean("frobnicate", known).empty());
  CHECK(did_you_mean("x", known).empty());
  CHECK(did_you_mean("", known).empty());
}

}  // namespace nef::test

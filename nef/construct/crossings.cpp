// SPDX-License-Identifier: Apache-2.0
#include "nef/construct/crossings.h"

#include "nef/base/counted.h"

namespace nef {
namespace {

struct Words {
  const char* name;
  const char* takes;
};

// In the order of the rules.
constexpr std::array<Words, kAllCrossings.size()> kWords{
    {{"refuse", "nothing"},
     {"union", "points that are enclosed at least once"},
     {"nonzero", "points whose winding number is not 0"},
     {"odd", "points that are enclosed an odd number of times"},
     {"outside", "points that cannot be reached from outside"},
     {"guess", "points with a winding number of at least one half (a guess)"}}};

}  // namespace

const char* name(Crossings rule) { return kWords[static_cast<std::size_t>(rule)].name; }

const char* taken_by(Crossings rule) { return kWords[static_cast<std::size_t>(rule)].takes; }

std::string crossing_text(std::size_t pairs) { return counted(pairs, "pair of faces crosses", "pairs of faces cross"); }

std::optional<Crossings> crossings_of_name(std::string_view wanted) {
  for (const Crossings rule : kAllCrossings) {
    if (name(rule) == wanted) return rule;
  }
  return std::nullopt;
}

bool is_taken(Crossings rule, int winding) {
  switch (rule) {
    case Crossings::kUnion:
      return winding > 0;
    case Crossings::kOdd:
      return winding % 2 != 0;
    case Crossings::kRefuse:
    case Crossings::kNonzero:
    case Crossings::kOutside:
    case Crossings::kGuess:
      break;
  }
  return winding != 0;
}

}  // namespace nef

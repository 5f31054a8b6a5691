// SPDX-License-Identifier: Apache-2.0
#include "nef/construct/crossings.h"

namespace nef {

const char* name(Crossings rule) {
  switch (rule) {
    case Crossings::kRefuse:
      return "refuse";
    case Crossings::kUnion:
      return "union";
    case Crossings::kNonzero:
      return "nonzero";
    case Crossings::kOdd:
      return "odd";
    case Crossings::kOutside:
      return "outside";
  }
  return "unknown";
}

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
      break;
  }
  return winding != 0;
}

const char* taken_by(Crossings rule) {
  switch (rule) {
    case Crossings::kRefuse:
      return "nothing";
    case Crossings::kUnion:
      return "what is enclosed at least once";
    case Crossings::kNonzero:
      return "what has a winding number other than 0";
    case Crossings::kOdd:
      return "what is enclosed an odd number of times";
    case Crossings::kOutside:
      return "what cannot be reached from outside";
  }
  return "nothing";
}

}  // namespace nef

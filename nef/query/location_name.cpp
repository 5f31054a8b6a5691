// SPDX-License-Identifier: Apache-2.0
#include "nef/query/location_name.h"

namespace nef {

std::string_view location_name(Location::Kind kind) {
  switch (kind) {
    case Location::Kind::kVertex:
      return "vertex";
    case Location::Kind::kEdge:
      return "edge";
    case Location::Kind::kFacet:
      return "facet";
    case Location::Kind::kVolume:
    case Location::Kind::kNone:
      break;
  }
  return "volume";
}

}  // namespace nef

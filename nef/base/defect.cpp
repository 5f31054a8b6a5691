// SPDX-License-Identifier: Apache-2.0
#include "nef/base/defect.h"

namespace nef {

std::string Defect::text() const {
  std::string text = invariant;
  for (const GuiltyItem& item : items) text += std::string(", ") + item.kind + " " + std::to_string(item.index);
  return text;
}

void detail::break_invariant(Defect::Kind kind, const char* name, std::initializer_list<GuiltyItem> guilty) {
  throw BrokenInvariant({kind, name, {guilty.begin(), guilty.end()}});
}

}  // namespace nef

// SPDX-License-Identifier: Apache-2.0
//
// All panels, by name.
#pragma once

#include <map>
#include <string>

#include "apps/studio/panels/panel.h"

namespace nef::studio {

/// The panels of the page. O(1).
inline const std::map<std::string, Panel>& panels() {
  static const std::map<std::string, Panel> kPanels{
      {"sets", sets_panel}, {"sums", sums_panel}, {"hulls", hulls_panel}, {"planner", planner_panel}};
  return kPanels;
}

}  // namespace nef::studio

// SPDX-License-Identifier: Apache-2.0
//
// OMPL's own planners by name.
#pragma once

#include <ompl/base/Planner.h>

#include <string>
#include <vector>

namespace nef::planner {

/// Names of the OMPL planners that make_ompl_planner knows.
std::vector<std::string> ompl_planner_names();

/// A planner by its OMPL name, any case ("RRTConnect", "PRMstar", "TightPlanner", ...). Throws InputError
/// with the known names for another one.
ompl::base::PlannerPtr make_ompl_planner(const std::string& name, const ompl::base::SpaceInformationPtr& si);

/// Throws InputError with the known names unless the planner is one that make_ompl_planner knows.
void require_ompl_planner(const std::string& name);

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// OMPL's planners by name.
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/sbl/SBL.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "apps/planner/ompl_runs.h"
#include "apps/planner/tight_planner.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

namespace og = ompl::geometric;

template <typename Planner>
ompl::base::PlannerPtr make(const ompl::base::SpaceInformationPtr& si) {
  return std::make_shared<Planner>(si);
}

const std::map<std::string, ompl::base::PlannerAllocator>& table() {
  static const std::map<std::string, ompl::base::PlannerAllocator> value{{"BITstar", make<og::BITstar>},
                                                                         {"BKPIECE1", make<og::BKPIECE1>},
                                                                         {"BiEST", make<og::BiEST>},
                                                                         {"EST", make<og::EST>},
                                                                         {"FMT", make<og::FMT>},
                                                                         {"InformedRRTstar", make<og::InformedRRTstar>},
                                                                         {"KPIECE1", make<og::KPIECE1>},
                                                                         {"LazyPRMstar", make<og::LazyPRMstar>},
                                                                         {"PRM", make<og::PRM>},
                                                                         {"PRMstar", make<og::PRMstar>},
                                                                         {"RRT", make<og::RRT>},
                                                                         {"RRTConnect", make<og::RRTConnect>},
                                                                         {"RRTstar", make<og::RRTstar>},
                                                                         {"SBL", make<og::SBL>},
                                                                         {"TightPlanner", make<TightPlanner>}};
  return value;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Throws for a name that is not known.
const ompl::base::PlannerAllocator& allocator_of(const std::string& name) {
  std::string known;
  for (const auto& [candidate, allocate] : table()) {
    if (lower(candidate) == lower(name)) return allocate;
    known += (known.empty() ? "" : ", ") + candidate;
  }
  throw InputError("unknown OMPL planner '" + name + "' (known: " + known + ")");
}

}  // namespace

std::vector<std::string> ompl_planner_names() {
  std::vector<std::string> names;
  for (const auto& item : table()) names.push_back(item.first);
  return names;
}

void require_ompl_planner(const std::string& name) { static_cast<void>(allocator_of(name)); }

ompl::base::PlannerPtr make_ompl_planner(const std::string& name, const ompl::base::SpaceInformationPtr& si) {
  return allocator_of(name)(si);
}

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/ompl/ompl_planners.h"

#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/est/ProjEST.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/pdst/PDST.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/prm/SPARS.h>
#include <ompl/geometric/planners/prm/SPARStwo.h>
#include <ompl/geometric/planners/rlrt/BiRLRT.h>
#include <ompl/geometric/planners/rlrt/RLRT.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/rrt/pRRT.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/sbl/pSBL.h>
#include <ompl/geometric/planners/sst/SST.h>
#include <ompl/geometric/planners/stride/STRIDE.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "apps/planner/ompl/tight_planner.h"
#include "nef/base/error.h"

namespace nef::planner {
namespace {

namespace og = ompl::geometric;

template <typename Planner>
ompl::base::PlannerPtr make(const ompl::base::SpaceInformationPtr& si) {
  return std::make_shared<Planner>(si);
}

// OMPL's benchmark asks planners for their progress, from a thread of its own, while they solve. Before OMPL 1.6, BIT*
// then counts its samples and vertices in tables that it is changing, and crashes at times (ompl/ompl, issue 779). It
// is asked for neither number.
template <typename Planner>
class NotCounted : public Planner {
 public:
  explicit NotCounted(const ompl::base::SpaceInformationPtr& si) : Planner(si) {
    for (const char* count : {"current free states INTEGER", "current graph vertices INTEGER"}) {
      this->plannerProgressProperties_.erase(count);
    }
  }
};

// All that need nothing but a space information. Not CForest, which puts a wrapper around the state space, so that its
// states are not ours; nor LazyLBTRRT, which ends by an assertion of its own in OMPL 1.5.2, on any space.
const std::map<std::string, ompl::base::PlannerAllocator>& table() {
  static const std::map<std::string, ompl::base::PlannerAllocator> value{
      // clang-format off
      {"ABITstar", make<NotCounted<og::ABITstar>>},
      {"AITstar", make<og::AITstar>},
      {"AnytimePathShortening", make<og::AnytimePathShortening>},
      {"BFMT", make<og::BFMT>},
      {"BITstar", make<NotCounted<og::BITstar>>},
      {"BKPIECE1", make<og::BKPIECE1>},
      {"BiEST", make<og::BiEST>},
      {"BiRLRT", make<og::BiRLRT>},
      {"BiTRRT", make<og::BiTRRT>},
      {"EST", make<og::EST>},
      {"FMT", make<og::FMT>},
      {"InformedRRTstar", make<og::InformedRRTstar>},
      {"KPIECE1", make<og::KPIECE1>},
      {"LBKPIECE1", make<og::LBKPIECE1>},
      {"LBTRRT", make<og::LBTRRT>},
      {"LazyPRM", make<og::LazyPRM>},
      {"LazyPRMstar", make<og::LazyPRMstar>},
      {"LazyRRT", make<og::LazyRRT>},
      {"PDST", make<og::PDST>},
      {"PRM", make<og::PRM>},
      {"PRMstar", make<og::PRMstar>},
      {"ProjEST", make<og::ProjEST>},
      {"RLRT", make<og::RLRT>},
      {"RRT", make<og::RRT>},
      {"RRTConnect", make<og::RRTConnect>},
      {"RRTXstatic", make<og::RRTXstatic>},
      {"RRTsharp", make<og::RRTsharp>},
      {"RRTstar", make<og::RRTstar>},
      {"SBL", make<og::SBL>},
      {"SORRTstar", make<og::SORRTstar>},
      {"SPARS", make<og::SPARS>},
      {"SPARStwo", make<og::SPARStwo>},
      {"SST", make<og::SST>},
      {"STRIDE", make<og::STRIDE>},
      {"TRRT", make<og::TRRT>},
      {"TightPlanner", make<TightPlanner>},
      {"pRRT", make<og::pRRT>},
      {"pSBL", make<og::pSBL>},
      // clang-format on
  };
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

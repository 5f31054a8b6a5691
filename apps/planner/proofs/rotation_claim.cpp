// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/proofs/rotation_claim.h"

#include <iterator>
#include <set>

#include "apps/planner/rigid/rigid_question.h"
#include "apps/planner/turning/turning_question.h"
#include "nef/number/floor.h"

namespace nef::planner {

RotationClaim rotation_claim_of(const Scene& scene) {
  if (scene.turns_freely) {
    const RigidQuestion question = rigid_question_of(scene);
    return {question.start, question.goal, {}, {}, {}};
  }
  const TurningQuestion question = question_of(scene);
  std::set<Turn> turns{question.low, question.high, question.start.turn, question.goal.turn};
  for (Integer quarter = ceiling_of(question.low); Turn(quarter) < question.high; ++quarter)
    turns.insert(Turn(quarter));
  RotationClaim result{{question.start.position, question.axis.quaternion(question.start.turn)},
                       {question.goal.position, question.axis.quaternion(question.goal.turn)},
                       {},
                       {turns.begin(), turns.end()},
                       {}};
  for (const Turn& turn : turns) {
    Quaternion q = question.axis.quaternion(turn);
    if (!result.chain.empty() && scalar_product(q, result.chain.back()) < 0) {
      for (Rational& x : q) x = -x;
    }
    result.chain.push_back(q);
  }
  if (question.high - question.low > 4) {
    const auto place = [&](const Turn& turn) {
      return static_cast<std::uint32_t>(std::distance(turns.begin(), turns.find(turn)));
    };
    result.places = {place(question.start.turn), place(question.goal.turn)};
  }
  return result;
}

}  // namespace nef::planner

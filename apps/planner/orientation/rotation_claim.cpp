// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/orientation/rotation_claim.h"

#include <set>
#include <utility>

#include "apps/planner/rigid/rigid_question.h"
#include "apps/planner/turning/turning_question.h"
#include "nef/base/error.h"
#include "nef/number/floor.h"

namespace nef::planner {

RotationClaim rotation_claim_of(const Scene& scene) {
  if (scene.turns_freely) {
    const RigidQuestion question = rigid_question_of(scene);
    return {question.start, question.goal, {}};
  }
  const TurningQuestion question = question_of(scene);
  if (question.high - question.low > 4) {
    throw InputError("angles in a range wider than a full turn have no proof of this kind");
  }
  std::set<Turn> turns{question.low, question.high, question.start.turn, question.goal.turn};
  for (Integer quarter = ceiling_of(question.low); Turn(quarter) < question.high; ++quarter)
    turns.insert(Turn(quarter));
  RotationClaim result{{question.start.position, question.axis.quaternion(question.start.turn)},
                       {question.goal.position, question.axis.quaternion(question.goal.turn)},
                       {}};
  for (const Turn& turn : turns) {
    Quaternion q = question.axis.quaternion(turn);
    if (!result.chain.empty() && scalar_product(q, result.chain.back()) < 0) {
      for (Rational& x : q) x = -x;
    }
    result.chain.push_back(q);
  }
  return result;
}

}  // namespace nef::planner

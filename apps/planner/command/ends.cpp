// SPDX-License-Identifier: Apache-2.0
#include "apps/planner/command/ends.h"

#include <array>
#include <vector>

#include "apps/program/numbers.h"
#include "nef/base/error.h"

namespace nef::planner {

void take_end(const std::string& text, const std::string& option, Scene& scene, bool is_goal) {
  if (text.empty()) return;
  const std::vector<Rational> numbers = parse_numbers(text, option);
  const std::size_t more = scene.turns_freely ? 7 : scene.rotation ? 4 : 3;
  if (numbers.size() != 3 && numbers.size() != more) {
    const char* known = scene.turns_freely ? " or x,y,z,qw,qx,qy,qz" : scene.rotation ? " or x,y,z,degrees" : "";
    throw InputError(option + ": expected x,y,z" + known + " instead of '" + text + "'");
  }
  (is_goal ? scene.goal : scene.start) = {numbers[0], numbers[1], numbers[2]};
  if (numbers.size() == 4) (is_goal ? scene.rotation->goal : scene.rotation->start) = numbers[3];
  if (numbers.size() < 7) return;
  const std::array<Rational, 4> quaternion{numbers[3], numbers[4], numbers[5], numbers[6]};
  if (quaternion == std::array<Rational, 4>{}) throw InputError(option + ": a rotation's quaternion must not be zero");
  (*scene.quaternions)[is_goal ? 1 : 0] = quaternion;
}

}  // namespace nef::planner

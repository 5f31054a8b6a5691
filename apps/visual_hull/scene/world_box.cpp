// SPDX-License-Identifier: Apache-2.0
#include "apps/visual_hull/scene/world_box.h"

#include "apps/program/numbers.h"
#include "apps/visual_hull/scene/scene_number.h"
#include "nef/base/error.h"
#include "nef/number/brief_text.h"

namespace nef::visual_hull {

using nef::Rational;

void check_box(const WorldBox& box, const std::string& where) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (box.low[i] >= box.high[i]) {
      throw nef::InputError(where + ": the box is empty or flat along " + std::string(1, "xyz"[i]) + " (" +
                            nef::brief_text(box.low[i]) + " to " + nef::brief_text(box.high[i]) + ")");
    }
  }
}

WorldBox parse_box(const std::string& text) {
  const std::vector<Rational> numbers = nef::parse_numbers(text, "--box");
  if (numbers.size() != 6) {
    throw nef::InputError("--box: six numbers x0,y0,z0,x1,y1,z1 are needed, not " + std::to_string(numbers.size()));
  }
  for (const Rational& number : numbers) check_size(number, "--box");
  WorldBox box{{numbers[0], numbers[1], numbers[2]}, {numbers[3], numbers[4], numbers[5]}};
  check_box(box, "--box");
  return box;
}

}  // namespace nef::visual_hull

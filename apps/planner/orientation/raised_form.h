// SPDX-License-Identifier: Apache-2.0
//
// Products of quadratic forms of a box of orientations and the parameters.
#pragma once

#include <array>
#include <cstddef>

namespace nef::planner {

/// A number for each Bernstein coefficient of a polynomial of degree 2, or 3, in each of three parameters; the first
/// index goes fastest, as in mixed_rotations.
template <class Number>
using QuadraticForm = std::array<Number, 27>;
template <class Number>
using CubicForm = std::array<Number, 64>;

/// The product of a quadratic form and the parameter `axis`, which goes from -1 to 1; of the form and 1 if `axis` is 3.
/// Each coefficient is multiplied by 3 for each of its indices that is 1 or 2, so that nothing is divided: sums and
/// signs of such products mean what they say. (Bernstein coefficients of f are f_0, f_1, f_2 and those of a linear l
/// are l_0 and l_1; those of f l are f_0 l_0, (f_0 l_1 + 2 f_1 l_0) / 3, (2 f_1 l_1 + f_2 l_0) / 3 and f_2 l_1.)
template <class Number>
CubicForm<Number> raised(const QuadraticForm<Number>& form, std::size_t axis) {
  CubicForm<Number> now{};
  for (std::size_t i = 0; i < form.size(); ++i) now[i] = form[i];
  // Axes before k have four coefficients, the others three.
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t inner = k == 0 ? 1 : k == 1 ? 4 : 16;
    const std::size_t outer = k == 0 ? 9 : k == 1 ? 3 : 1;
    CubicForm<Number> next{};
    for (std::size_t o = 0; o < outer; ++o) {
      for (std::size_t i = 0; i < inner; ++i) {
        const Number& first = now[3 * o * inner + i];
        const Number second = 2 * now[(3 * o + 1) * inner + i];
        const Number& third = now[(3 * o + 2) * inner + i];
        Number* const to = &next[4 * o * inner + i];
        to[0] = k == axis ? Number(-first) : first;
        to[inner] = k == axis ? Number(first - second) : Number(first + second);
        to[2 * inner] = k == axis ? Number(second - third) : Number(second + third);
        to[3 * inner] = third;
      }
    }
    now = next;
  }
  return now;
}

}  // namespace nef::planner

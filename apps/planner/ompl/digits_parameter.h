// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

namespace nef::planner {

/// OMPL's parameters are numbers: -1 stands for as many decimals as a way-point has. Throws std::invalid_argument for
/// other negative numbers or more than 300, which makes params().setParam return false.
inline std::optional<unsigned> digits_of_parameter(int digits) {
  if (digits < -1 || digits > 300) {
    throw std::invalid_argument("digits must be -1 (no bound) or 0 to 300, not " + std::to_string(digits));
  }
  if (digits < 0) return std::nullopt;
  return static_cast<unsigned>(digits);
}

inline int parameter_of_digits(const std::optional<unsigned>& digits) {
  return digits ? static_cast<int>(*digits) : -1;
}

}  // namespace nef::planner

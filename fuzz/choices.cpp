// SPDX-License-Identifier: Apache-2.0
#include "fuzz/choices.h"

#include <algorithm>

namespace nef::fuzz {
namespace {

constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15U;

std::uint64_t scrambled(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

}  // namespace

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return scrambled(scrambled(a + kGolden) + b + kGolden); }

std::uint32_t Choices::below(std::uint32_t n) {
  std::uint32_t value = 0;
  if (random_) {
    state_ += kGolden;
    value = static_cast<std::uint32_t>((scrambled(state_) >> 32U) * n >> 32U);
  } else if (drawn_.size() < script_.size()) {
    value = std::min(script_[drawn_.size()], n - 1);
  }
  drawn_.push_back(value);
  if (listener_) listener_(value);
  return value;
}

int Choices::between(int low, int high) {
  return low + static_cast<int>(below(static_cast<std::uint32_t>(high - low + 1)));
}

}  // namespace nef::fuzz

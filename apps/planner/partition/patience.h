// SPDX-License-Identifier: Apache-2.0
//
// Long constructions that can be stopped.
#pragma once

#include <cstdint>
#include <functional>

#include "nef/base/interruption.h"

namespace nef::planner {

/// Asks now and then whether to stop.
class Patience {
 public:
  Patience() = default;
  explicit Patience(std::function<bool()> stop) : stop_(std::move(stop)) {}

  /// To be called for every piece of work of some microseconds. Throws Interrupted if it is time to stop.
  void check() {
    if (stop_ && ++count_ % 64 == 0 && stop_()) throw Interrupted();
  }

 private:
  std::function<bool()> stop_;
  std::uint32_t count_ = 0;
};

}  // namespace nef::planner

// SPDX-License-Identifier: Apache-2.0
//
// The sfaces of shells, which a complex does not list: it takes a pass to find them, and few ask.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "nef/complex/complex.h"

namespace nef {

/// The sfaces of each shell of a complex, ascending.
class ShellSfaces {
 public:
  /// O(sfaces).
  explicit ShellSfaces(const Complex& complex);

  [[nodiscard]] std::span<const SFaceId> of(ShellId shell) const {
    return {sfaces_.data() + begin_[shell], begin_[shell.next()] - begin_[shell]};
  }

 private:
  IndexedVector<ShellId, std::uint32_t> begin_;
  std::vector<SFaceId> sfaces_;
};

}  // namespace nef

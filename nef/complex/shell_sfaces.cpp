// SPDX-License-Identifier: Apache-2.0
#include "nef/complex/shell_sfaces.h"

namespace nef {

ShellSfaces::ShellSfaces(const Complex& complex)
    : begin_(complex.shells.size() + 1, 0), sfaces_(complex.sface_shell.size()) {
  for (const ShellId s : complex.sface_shell) ++begin_[s];
  std::uint32_t end = 0;
  for (std::uint32_t& begin : begin_) {
    end += begin;
    begin = end;
  }
  // From behind, each begin moves down to where it is.
  for (auto i = sfaces_.size(); i-- > 0;) sfaces_[--begin_[complex.sface_shell[SFaceId{i}]]] = SFaceId{i};
}

}  // namespace nef

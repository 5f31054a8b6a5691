// SPDX-License-Identifier: Apache-2.0
//
// Smaller cases that fail in the same way.
#pragma once

#include "fuzz/isolation.h"

namespace nef::fuzz {

/// Tries to leave out and to lower choices for at most `seconds`, as long as the complaint stays of the same kind (what
/// stands before its first colon). Returns the smallest failing case found.
Finding shrunk(const Fuzzer& fuzzer, Finding finding, double seconds);

}  // namespace nef::fuzz

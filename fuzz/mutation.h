// SPDX-License-Identifier: Apache-2.0
//
// Damage to files.
#pragma once

#include <string>

#include "fuzz/choices.h"

namespace nef::fuzz {

/// The text with one to four small changes: bytes flipped, words replaced by others or by awkward ones, ranges left
/// out, doubled or moved, the end cut off.
std::string mutated(Choices& choices, std::string text);

}  // namespace nef::fuzz

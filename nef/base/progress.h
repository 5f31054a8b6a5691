// SPDX-License-Identifier: Apache-2.0
//
// How a long computation tells how far it has come.
#pragma once

#include <cstddef>
#include <functional>

namespace nef {

/// Told what is being done, how much of it is done, and how much there is; a total of 0 means that it is not known.
using ProgressFunction = std::function<void(const char* phase, std::size_t done, std::size_t total)>;

}  // namespace nef

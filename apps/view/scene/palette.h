// SPDX-License-Identifier: Apache-2.0
//
// The colours of lines and points, in pages, pictures and glTF files alike.
#pragma once

#include "apps/view/layer.h"

namespace nef::view {

inline constexpr Color kInk{31, 58, 90};       ///< what is selected
inline constexpr Color kOrange{217, 102, 43};  ///< what is not

}  // namespace nef::view

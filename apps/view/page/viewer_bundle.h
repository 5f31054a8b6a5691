// SPDX-License-Identifier: Apache-2.0
//
// The viewer page that CMake puts together from apps/view/web and three.js.
#pragma once

#include <string_view>

namespace nef::view {

/// The page with the marks @NEF_TITLE@ and @NEF_SCENE@ to fill in; empty if it was not built.
std::string_view viewer_bundle();

}  // namespace nef::view

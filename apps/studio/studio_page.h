// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace nef::studio {

/// The page that was made at build time from web/, the viewer of apps/view/web and three.js; empty if it was not.
std::string_view studio_page();

}  // namespace nef::studio

// SPDX-License-Identifier: Apache-2.0
//
// The switch of all fast paths that have a slower twin with the same results (docs/reliability.md lists them).
#pragma once

namespace nef {

/// False in a build with the option NEF_SLOW_PATHS: every computation takes the slow twin of its fast paths. Such a
/// build gives the same bytes in more time, which CI compares.
#ifdef NEF_SLOW_PATHS
inline constexpr bool kFastPaths = false;
#else
inline constexpr bool kFastPaths = true;
#endif

}  // namespace nef

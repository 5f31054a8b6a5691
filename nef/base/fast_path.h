// SPDX-License-Identifier: Apache-2.0
//
// The switch of all fast paths that have a slower twin with the same results (docs/reliability.md lists them).
#pragma once

namespace nef {

/// False in a build with the option NEF_SLOW_PATHS: computations take the slow twins of their fast paths, which give
/// the same bytes in more time.
#ifdef NEF_SLOW_PATHS
inline constexpr bool kFastPaths = false;
#else
inline constexpr bool kFastPaths = true;
#endif

}  // namespace nef

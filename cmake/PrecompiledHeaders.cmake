# SPDX-License-Identifier: Apache-2.0
#
# Headers of the standard library and of packages, compiled once and read by every source of ours: a third of a build on
# cold cores is parsing them again. README's commands, which build once, ask for it. Off otherwise: ccache cannot share
# objects that read such headers between checkouts. Sources include what they use, and compile without.
option(NEF_PRECOMPILED_HEADERS "Compile headers of packages once" OFF)

set(NEF_COMMON_HEADERS
    <algorithm> <array> <atomic> <bit> <cmath> <cstdint> <functional> <limits> <map> <memory> <numeric> <optional> <set>
    <span> <sstream> <string> <string_view> <unordered_map> <utility> <variant> <vector> <gmpxx.h>)

if(NEF_PRECOMPILED_HEADERS AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 then takes its own std::string for a source of ours and reports copies inside (GCC bugs 105329, 105651). The
  # preset `ci` builds without such headers, and so with these warnings.
  target_compile_options(nef_options INTERFACE -Wno-array-bounds -Wno-stringop-overflow)
endif()

# precompile_headers(TARGET HEADERS...): the common headers and these, for sources of TARGET.
function(precompile_headers target)
  if(NEF_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} PRIVATE ${NEF_COMMON_HEADERS} ${ARGN})
  endif()
endfunction()

# share_precompiled_headers(OWNER TARGETS...): TARGETS are compiled with the same options, and read what OWNER compiled.
function(share_precompiled_headers owner)
  if(NEF_PRECOMPILED_HEADERS)
    foreach(target ${ARGN})
      target_precompile_headers(${target} REUSE_FROM ${owner})
    endforeach()
  endif()
endfunction()

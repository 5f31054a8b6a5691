# SPDX-License-Identifier: Apache-2.0
#
# find_package(nef) gives the target nef::nef. GMP with its C++ interface must be installed
# (Debian: libgmp-dev); its place is recorded in the target. oneTBB is looked for (libtbb-dev).
include(CMakeFindDependencyMacro)
find_dependency(TBB)
include(${CMAKE_CURRENT_LIST_DIR}/nef-targets.cmake)

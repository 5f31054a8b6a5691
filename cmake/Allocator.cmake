# SPDX-License-Identifier: Apache-2.0
#
# Programs take their memory from jemalloc where it is found: it asks the system for pages of two megabytes, which saves
# 15 to 30 % of the time of large sets (bench/results/minkowski.md). -DJEMALLOC_LIBRARY=OFF builds without. Libraries leave the choice to the program that uses them.
# Not with sanitizers, which have allocators of their own.
add_library(nef_allocator INTERFACE)
find_library(JEMALLOC_LIBRARY jemalloc)
if(JEMALLOC_LIBRARY AND NOT NEF_SANITIZE)
  target_sources(nef_allocator INTERFACE ${PROJECT_SOURCE_DIR}/apps/program/allocator/jemalloc_options.cpp)
  target_link_libraries(nef_allocator INTERFACE ${JEMALLOC_LIBRARY})
  target_compile_definitions(nef_allocator INTERFACE NEF_WITH_JEMALLOC)
endif()

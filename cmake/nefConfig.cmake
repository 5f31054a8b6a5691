# SPDX-License-Identifier: Apache-2.0
#
# find_package(nef) gives the targets nef::nef and nef::minkowski. GMP with its C++ interface must be installed
# (Debian: libgmp-dev), and so must libzip and expat (libzip-dev, libexpat1-dev); their places are recorded in the
# target. oneTBB is looked for (libtbb-dev).
#
# Each of these components gives the target nef::COMPONENT, too, and looks for what that needs:
#   view         pages, pictures, GLB files    libpng, zlib
#   planner      the translational planner     OMPL and assimp (their places are recorded), Eigen, Boost, threads
#   visual_hull  hulls of silhouettes          OpenCV, Eigen, fmt, libpng, zlib
include(CMakeFindDependencyMacro)
find_dependency(TBB)
include(${CMAKE_CURRENT_LIST_DIR}/nef-targets.cmake)
foreach(component IN LISTS nef_FIND_COMPONENTS)
  # Known to have been built and installed by its file of targets.
  set(nef_targets_file ${CMAKE_CURRENT_LIST_DIR}/nef-${component}-targets.cmake)
  if(EXISTS ${nef_targets_file})
    if(component STREQUAL "view")
      find_dependency(PNG)
      find_dependency(ZLIB)
    elseif(component STREQUAL "planner")
      find_dependency(Eigen3)
      find_dependency(Boost)
      find_dependency(Threads)
    elseif(component STREQUAL "visual_hull")
      find_dependency(OpenCV COMPONENTS core imgproc calib3d aruco)
      find_dependency(Eigen3)
      find_dependency(fmt)
      find_dependency(PNG)
      find_dependency(ZLIB)
      include(${CMAKE_CURRENT_LIST_DIR}/nef-view-targets.cmake)
    endif()
    include(${nef_targets_file})
    set(nef_${component}_FOUND TRUE)
  elseif(component STREQUAL "minkowski" AND TARGET nef::minkowski)
    set(nef_minkowski_FOUND TRUE)
  endif()
endforeach()
foreach(component IN LISTS nef_FIND_COMPONENTS)
  if(nef_FIND_REQUIRED_${component} AND NOT nef_${component}_FOUND)
    set(nef_FOUND FALSE)
    set(nef_NOT_FOUND_MESSAGE "the component ${component} was not installed with this nef (components: minkowski, planner, view, visual_hull)")
  endif()
endforeach()

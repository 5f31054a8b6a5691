# SPDX-License-Identifier: Apache-2.0
#
# find_package(nef) gives the targets nef::nef and nef::minkowski. GMP with its C++ interface must be installed
# (Debian: libgmp-dev), and so must libzip and expat (libzip-dev, libexpat1-dev); their places are recorded in the
# target. oneTBB is looked for (libtbb-dev).
# The component visual_hull gives nef::visual_hull, too; it looks for OpenCV, Eigen and fmt.
include(CMakeFindDependencyMacro)
find_dependency(TBB)
include(${CMAKE_CURRENT_LIST_DIR}/nef-targets.cmake)
if("visual_hull" IN_LIST nef_FIND_COMPONENTS AND EXISTS ${CMAKE_CURRENT_LIST_DIR}/nef-visual_hull-targets.cmake)
  find_dependency(OpenCV COMPONENTS core imgproc imgcodecs calib3d)
  find_dependency(Eigen3)
  find_dependency(fmt)
  include(${CMAKE_CURRENT_LIST_DIR}/nef-visual_hull-targets.cmake)
  set(nef_visual_hull_FOUND TRUE)
endif()

# SPDX-License-Identifier: Apache-2.0
#
# Installs the library from BUILD below WORK and builds and runs the project in SOURCE against it.
file(REMOVE_RECURSE ${WORK})
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${code}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed --component development)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -DCMAKE_PREFIX_PATH=${WORK}/installed
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/build)

# Every library that was built has to have been found, and its example prints what is known.
function(check name printed)
  if(NOT EXISTS ${WORK}/build/${name})
    if(EXISTS ${BUILD}/${ARGN})
      message(FATAL_ERROR "${name} was not built, though ${ARGN} was")
    endif()
    return()
  endif()
  run(${WORK}/build/${name})
  if(NOT output STREQUAL "${printed}\n")
    message(FATAL_ERROR "${name} printed '${output}' instead of ${printed}")
  endif()
endfunction()
check(example 4 nef/libnef.a)
check(sum_example 27 apps/minkowski/libnef_minkowski.a)
check(hull_example 36 apps/visual_hull/libnef_visual_hull.a)
check(plan_example "a path" apps/planner/libnef_planner.a)
check(view_example "a picture of 64x48" apps/view/libnef_view.a)

# Without CMake.
find_program(PKG_CONFIG pkg-config)
file(GLOB_RECURSE pc ${WORK}/installed/nef.pc)
if(PKG_CONFIG)
  get_filename_component(folder ${pc} DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} ${folder})
  run(${PKG_CONFIG} --cflags --libs nef)
  separate_arguments(flags UNIX_COMMAND "${output}")
  run(${COMPILER} -std=c++20 ${SOURCE}/plain.cpp -o ${WORK}/plain_example ${flags})
  run(${WORK}/plain_example)
  if(NOT output STREQUAL "4\n")
    message(FATAL_ERROR "without CMake, the example printed '${output}' instead of 4")
  endif()
endif()

# The projects of the tutorials, from their pages.
if(PYTHON)
  set(pages ${SOURCE}/../../../docs/tutorials/cmake.md)
  if(EXISTS ${BUILD}/apps/planner/libnef_planner.a)
    list(APPEND pages ${SOURCE}/../../../docs/tutorials/ompl.md)
  endif()
  run(${CMAKE_COMMAND} -E env NEF_PREFIX=${WORK}/installed CXX=${COMPILER} ${PYTHON} ${SOURCE}/../../docs/run_commands.py
      ${SOURCE}/../../.. ${BUILD}/bin ${WORK}/tutorials ${pages})
endif()

# SPDX-License-Identifier: Apache-2.0
#
# The sources of a target in few translation units: whole folders, one after the other, until a unit has so many sources.
# Headers are then parsed a few times for each target instead of once for each source, which is most of the work of a build
# on cold cores. README's commands, which build once, ask for it; who changes sources is better off without. It needs names
# of file scope that differ within a target.
option(NEF_COMPILE_TOGETHER "Compile the sources of each target in few translation units" OFF)
set(NEF_SOURCES_TOGETHER 40 CACHE STRING "How many sources a translation unit has about, with NEF_COMPILE_TOGETHER")
mark_as_advanced(NEF_SOURCES_TOGETHER)

function(compile_together target)
  get_target_property(type ${target} TYPE)
  if(NOT type MATCHES "^(STATIC_LIBRARY|SHARED_LIBRARY|EXECUTABLE|MODULE_LIBRARY)$")
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  get_target_property(root ${target} SOURCE_DIR)
  set(unit 0)
  set(in_unit 0)
  set(last_folder "")
  foreach(source ${sources})
    get_filename_component(source ${source} ABSOLUTE BASE_DIR ${root})
    get_filename_component(folder ${source} DIRECTORY)
    if(in_unit GREATER_EQUAL NEF_SOURCES_TOGETHER AND NOT folder STREQUAL last_folder)
      math(EXPR unit "${unit} + 1")
      set(in_unit 0)
    endif()
    math(EXPR in_unit "${in_unit} + 1")
    set(last_folder ${folder})
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${unit})
  endforeach()
endfunction()

function(compile_all_together directory)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    compile_together(${target})
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory ${subdirectories})
    compile_all_together(${subdirectory})
  endforeach()
endfunction()

if(NEF_COMPILE_TOGETHER)
  compile_all_together(${PROJECT_SOURCE_DIR})
endif()

# SPDX-License-Identifier: Apache-2.0
#
# The sources of one folder of a target as one translation unit, so that headers are parsed once for each folder: less than
# half of the work of a build on cold cores. README's commands, which build once, ask for it; who changes sources is better
# off without. It needs names of file scope that differ within a folder.
option(NEF_COMPILE_BY_FOLDER "Compile the sources of each folder as one" OFF)

function(compile_by_folder target)
  get_target_property(type ${target} TYPE)
  if(NOT type MATCHES "^(STATIC_LIBRARY|EXECUTABLE|MODULE_LIBRARY)$")
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  get_target_property(root ${target} SOURCE_DIR)
  foreach(source ${sources})
    get_filename_component(source ${source} ABSOLUTE BASE_DIR ${root})
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${folder})
  endforeach()
endfunction()

function(compile_all_by_folder directory)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    compile_by_folder(${target})
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory ${subdirectories})
    compile_all_by_folder(${subdirectory})
  endforeach()
endfunction()

if(NEF_COMPILE_BY_FOLDER)
  compile_all_by_folder(${PROJECT_SOURCE_DIR})
endif()

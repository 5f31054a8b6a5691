# SPDX-License-Identifier: Apache-2.0
#
# nef_installed_library(TARGET EXPORT_SET): a library that other projects link. Static, or, with BUILD_SHARED_LIBS, a shared
# one: its SONAME has the version up to which nothing breaks (docs of stability: CONTRIBUTING.md), it exports what is in the
# suite's namespace, and nothing of what it is made of. Components: `libraries` is what programs need to run,
# `development` what one compiles with.
include(GNUInstallDirs)

# Until 1.0, versions that differ in the second number may break anything.
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(NEF_SOVERSION 0.${PROJECT_VERSION_MINOR})
else()
  set(NEF_SOVERSION ${PROJECT_VERSION_MAJOR})
endif()
set(NEF_EXPORTED_SYMBOLS ${CMAKE_CURRENT_LIST_DIR}/exported_symbols.map)

# Programs and libraries find each other wherever the tree is moved.
if(BUILD_SHARED_LIBS)
  set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
endif()

function(nef_installed_library target export_set)
  # Without a symbol of its own, an object is the same for both kinds of library, and a compiler cache has it.
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${NEF_SOVERSION} DEFINE_SYMBOL "")
  if(BUILD_SHARED_LIBS AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
    target_link_options(${target} PRIVATE LINKER:--version-script=${NEF_EXPORTED_SYMBOLS})
    set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${NEF_EXPORTED_SYMBOLS})
  endif()
  install(TARGETS ${target} EXPORT ${export_set}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT development)
endfunction()

# SPDX-License-Identifier: Apache-2.0
#
# The target api_docs: the public headers as pages in api_docs/html of the build folder, and undocumented public
# declarations as a list in api_docs/undocumented.txt, which is printed. Left out where Doxygen is not installed.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  message(STATUS "api_docs: no such target, since Doxygen was not found (apt-get install doxygen)")
  return()
endif()

# What CONTRIBUTING.md calls stable, and the public headers of the applications.
file(GLOB NEF_PUBLIC_HEADERS CONFIGURE_DEPENDS
     nef/*.h nef/base/error.h nef/number/number.h nef/construct/construct.h nef/construct/convex_hull.h
     nef/export/to_mesh.h nef/mesh/mesh_check.h nef/export/convert_*.h nef/io/polyhedron_file.h
     nef/io/mesh/mesh_reader.h nef/io/mesh/mesh_writer.h nef/io/native/native_format.h nef/io/cgal/cgal_nef3.h nef/query/measure.h
     nef/query/explore.h nef/query/moments.h nef/construct/round_shapes.h
     apps/minkowski/minkowski.h apps/visual_hull/visual_hull.h
     apps/planner/ompl/translation_planning.h)

set(DOXYGEN_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/api_docs)
set(DOXYGEN_GENERATE_LATEX NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_EXTRACT_ALL NO)
set(DOXYGEN_WARN_IF_UNDOCUMENTED YES)
set(DOXYGEN_WARN_NO_PARAMDOC NO)
set(DOXYGEN_WARN_LOGFILE ${CMAKE_BINARY_DIR}/api_docs/undocumented.txt)
set(DOXYGEN_EXCLUDE_SYMBOLS "nef::detail" "*::internal")
set(DOXYGEN_STRIP_FROM_PATH ${PROJECT_SOURCE_DIR})
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_DISTRIBUTE_GROUP_DOC YES)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/api_docs)
doxygen_add_docs(api_docs_pages ${NEF_PUBLIC_HEADERS} COMMENT "Doxygen over the public headers")
add_custom_target(api_docs COMMAND ${CMAKE_COMMAND} -E cat ${DOXYGEN_WARN_LOGFILE} DEPENDS api_docs_pages VERBATIM)

# SPDX-License-Identifier: Apache-2.0
#
# The target api_docs: the public headers as pages in api_docs of the build folder, by docs/reference/Doxyfile, and public
# declarations without a description as a list, which is printed. Left out where Doxygen is not installed.
find_program(NEF_DOXYGEN doxygen)
if(NOT NEF_DOXYGEN)
  message(STATUS "api_docs: no such target, since Doxygen was not found (apt-get install doxygen)")
  return()
endif()
set(reference ${CMAKE_BINARY_DIR}/api_docs)
file(MAKE_DIRECTORY ${reference})
add_custom_target(api_docs COMMAND ${CMAKE_COMMAND} -E env NEF_REFERENCE=${reference} ${NEF_DOXYGEN} docs/reference/Doxyfile
                  COMMAND ${CMAKE_COMMAND} -E cat ${reference}/undocumented.txt
                  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "Doxygen over the public headers" VERBATIM)

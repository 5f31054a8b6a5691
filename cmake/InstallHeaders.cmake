# SPDX-License-Identifier: Apache-2.0
#
# At installation: the public headers, which are those of the C++ reference (docs/reference/Doxyfile) and nef/nef.h, and
# the headers that they include. Nothing else is installed, so nobody can come to depend on it. Set before: NEF_SOURCE, the
# project; NEF_INCLUDE, the folder of headers below the prefix; NEF_FOLDERS, the folders whose libraries were built.
cmake_policy(VERSION 3.25)
file(READ ${NEF_SOURCE}/docs/reference/Doxyfile reference)
string(REGEX MATCHALL "(nef|apps)/[a-z_0-9/]+\\.h" waiting "${reference}")
list(PREPEND waiting nef/nef.h)
set(headers "")
while(waiting)
  list(POP_FRONT waiting header)
  string(REGEX MATCH "^(nef|apps/[a-z_]+)/" folder ${header})
  if(header IN_LIST headers OR NOT folder IN_LIST NEF_FOLDERS)
    continue()
  endif()
  list(APPEND headers ${header})
  file(STRINGS ${NEF_SOURCE}/${header} includes REGEX "^#include \"")
  foreach(include ${includes})
    string(REGEX REPLACE "^#include \"([^\"]*)\".*" "\\1" name "${include}")
    list(APPEND waiting ${name})
  endforeach()
endwhile()
list(SORT headers)
foreach(header ${headers})
  # Headers of the applications have their own root: #include "apps/minkowski/minkowski.h".
  if(header MATCHES "^apps/")
    set(place nef-suite/${header})
  else()
    set(place ${header})
  endif()
  get_filename_component(folder ${place} DIRECTORY)
  file(INSTALL DESTINATION ${CMAKE_INSTALL_PREFIX}/${NEF_INCLUDE}/${folder} TYPE FILE FILES ${NEF_SOURCE}/${header})
endforeach()

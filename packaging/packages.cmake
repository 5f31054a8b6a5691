# SPDX-License-Identifier: Apache-2.0
#
# Man pages, completions, documents, and Debian packages by `cpack -G DEB`.
include(GNUInstallDirs)
find_program(GZIP gzip)

# compressed(FILE): FILE.gz as Debian wants it, the same bytes at any time.
function(compressed file)
  add_custom_command(OUTPUT ${file}.gz COMMAND ${GZIP} -9 -n -k -f ${file} DEPENDS ${file} VERBATIM)
endfunction()

foreach(name nef visual_hull minkowski planner)
  # bash-completion looks a file up by the name of the command.
  install(FILES cmake/completions/nef DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          RENAME ${name} COMPONENT programs)
endforeach()

# What the documentation's examples read.
install(DIRECTORY data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/nef-programs/data COMPONENT programs)

# Man pages from the programs' own help and that of their subcommands, where help2man is installed.
set(about_nef_command "exact Boolean and other operations on Nef polyhedra")
set(about_visual_hull "exact visual hulls from calibrated silhouettes")
set(about_render_silhouettes "silhouettes of a mesh from cameras around it, with their scene")
set(about_minkowski "exact Minkowski sums, offsets and hulls of polyhedral sets")
set(about_planner "exact motion planning: paths, or proofs that there is none")
set(about_nef_mpi "exact unions, Minkowski sums and visual hulls on many ranks")
find_program(HELP2MAN help2man)
find_program(NEF_PYTHON3 python3)
set(packaged_files "")
if(HELP2MAN AND NEF_PYTHON3 AND GZIP)
  foreach(program nef_command visual_hull render_silhouettes minkowski planner nef_mpi)
    if(NOT TARGET ${program})
      continue()
    endif()
    get_target_property(name ${program} OUTPUT_NAME)
    if(NOT name)
      set(name ${program})
    endif()
    set(page ${CMAKE_BINARY_DIR}/man/${name}.1)
    add_custom_command(
      OUTPUT ${page}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/man
      COMMAND ${NEF_PYTHON3} ${PROJECT_SOURCE_DIR}/cmake/man_sections.py $<TARGET_FILE:${program}> ${name}
              ${page}.include
      COMMAND ${HELP2MAN} --no-info --no-discard-stderr --version-string=${PROJECT_VERSION} --name=${about_${program}}
              --opt-include=${page}.include -o ${page} $<TARGET_FILE:${program}>
      DEPENDS ${program} ${PROJECT_SOURCE_DIR}/cmake/man_sections.py VERBATIM)
    compressed(${page})
    list(APPEND packaged_files ${page}.gz)
    set(component programs)
    if(program STREQUAL "nef_mpi")
      set(component mpi)
    endif()
    install(FILES ${page}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
  endforeach()
endif()

# The date of the packages is that of CHANGELOG.md, unless SOURCE_DATE_EPOCH says otherwise.
file(TIMESTAMP ${PROJECT_SOURCE_DIR}/CHANGELOG.md NEF_PACKAGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(packaging/changelog.in ${CMAKE_BINARY_DIR}/packaging/changelog @ONLY)
if(GZIP)
  compressed(${CMAKE_BINARY_DIR}/packaging/changelog)
  list(APPEND packaged_files ${CMAKE_BINARY_DIR}/packaging/changelog.gz)
endif()
add_custom_target(packaged_files ALL DEPENDS ${packaged_files})

set(package_of_programs nef-programs)
set(package_of_development libnef-dev)
set(package_of_python python3-nef)
set(package_of_mpi nef-mpi)
set(CPACK_COMPONENTS_ALL programs development)
if(TARGET nef_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(TARGET nef_mpi)
  list(APPEND CPACK_COMPONENTS_ALL mpi)
endif()
foreach(component ${CPACK_COMPONENTS_ALL})
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${package_of_${component}})
  install(FILES packaging/copyright CHANGELOG.md DESTINATION ${folder} COMPONENT ${component})
  # Only where it was made: an installation by hand needs none.
  install(FILES ${CMAKE_BINARY_DIR}/packaging/changelog.gz DESTINATION ${folder} COMPONENT ${component} OPTIONAL)
endforeach()
# The pages, and what they link to, in the folders that their links name.
foreach(component programs development)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${package_of_${component}})
  install(DIRECTORY docs DESTINATION ${folder} COMPONENT ${component})
  install(FILES README.md CONTRIBUTING.md DESTINATION ${folder} COMPONENT ${component})
  install(FILES bench/README.md DESTINATION ${folder}/bench COMPONENT ${component})
  install(FILES packaging/README.md DESTINATION ${folder}/packaging COMPONENT ${component})
  install(DIRECTORY bench/results DESTINATION ${folder}/bench COMPONENT ${component} FILES_MATCHING PATTERN "*.md")
  install(DIRECTORY python/examples DESTINATION ${folder}/python COMPONENT ${component} FILES_MATCHING PATTERN "*.ipynb")
endforeach()
set(folder ${CMAKE_INSTALL_DATADIR}/doc/${package_of_development}/data)
install(FILES data/README.md DESTINATION ${folder} COMPONENT development)
install(FILES data/visual_hull/README.md DESTINATION ${folder}/visual_hull COMPONENT development)

set(CPACK_PACKAGE_NAME nef-suite)
set(CPACK_PACKAGE_CONTACT "nef suite maintainers <maintainers@nef-suite.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "exact solid geometry with Nef polyhedra")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_SECTION math)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME ${package_of_development})
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libgmp-dev, libtbb-dev, libzip-dev, libexpat1-dev")
# For the components view, visual_hull and planner of find_package(nef).
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS
    "libpng-dev, zlib1g-dev, libopencv-dev, libeigen3-dev, libfmt-dev, libmatio-dev, libompl-dev, libassimp-dev, libboost-dev, liburdfdom-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "static libraries and headers\n Nef polyhedra with exact arithmetic, Minkowski sums, visual hulls from\n silhouettes, a planner for translating robots, and pages to look at them.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME ${package_of_programs})
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "${NEF_LOADED_PACKAGES}") # at run time, so not seen in the programs
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION
    "programs and sample data\n nef (Booleans and more), minkowski (sums, offsets), visual_hull (solids from\n silhouettes) and planner (motions through passages as tight as the robot).")
set(CPACK_DEBIAN_MPI_PACKAGE_NAME ${package_of_mpi})
set(CPACK_DEBIAN_MPI_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "openmpi-bin")
set(CPACK_COMPONENT_MPI_DESCRIPTION
    "program for clusters\n nef_mpi: unions, Minkowski sums and visual hulls of video on many ranks.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME ${package_of_python})
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "package for Python\n import nef: the suite in Python, with numpy.")
# Extension modules are for one version of Python.
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${NEF_PYTHON_VERSION}), python3 (<< ${NEF_PYTHON_NEXT_VERSION}~), python3-numpy")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
include(CPack)

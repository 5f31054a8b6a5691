# SPDX-License-Identifier: Apache-2.0
#
# Packs the Python package of TREE as a wheel, installs it alone into an empty folder below WORK, and runs the examples with
# nothing of the source or build tree on the path.
file(REMOVE_RECURSE ${WORK})
file(COPY ${SOURCE}/python/examples DESTINATION ${WORK}/elsewhere)
file(COPY ${SOURCE}/python/tests/test_examples.py ${SOURCE}/python/tests/conftest.py DESTINATION ${WORK}/elsewhere/tests)
# Pages whose examples it runs, where it looks for them.
file(COPY ${SOURCE}/README.md DESTINATION ${WORK})
file(COPY ${SOURCE}/docs/tutorials/python.md DESTINATION ${WORK}/docs/tutorials)
file(COPY ${SOURCE}/docs/python.md ${SOURCE}/docs/labels.md DESTINATION ${WORK}/docs)
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK}/elsewhere OUTPUT_VARIABLE output ERROR_VARIABLE output
                  RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${code}\n${output}")
  endif()
endfunction()
# setuptools writes beside the sources, so it works on a copy of what it needs.
foreach(name pyproject.toml setup.py nef/version.h LICENSE docs/python.md)
  configure_file(${SOURCE}/${name} ${WORK}/source/${name} COPYONLY)
endforeach()
run(${CMAKE_COMMAND} -E env NEF_BUILD_TREE=${TREE} ${PYTHON} -m pip wheel -q --no-build-isolation --no-deps --no-index
    -w ${WORK}/dist ${WORK}/source)
file(GLOB wheel ${WORK}/dist/nef-*.whl)
run(${PYTHON} -m pip install -q --no-deps --no-index --target ${WORK}/installed ${wheel})
run(${CMAKE_COMMAND} -E env PYTHONPATH=${WORK}/installed ${PYTHON} -m pytest -q -p no:cacheprovider tests)

# Installs into the build tree and builds examples/own-project against it, as a stranger would. Stops at the first step
# that fails.
set(work ${BUILD}/own-project)
file(REMOVE_RECURSE ${work})
macro(step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${out}")
  endif()
endmacro()
step(${CMAKE_COMMAND} --install ${BUILD} --component library --prefix ${work}/prefix)
step(${CMAKE_COMMAND} -S ${SOURCE}/examples/own-project -B ${work}/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${work}/prefix -DCMAKE_BUILD_TYPE=Release)
step(${CMAKE_COMMAND} --build ${work}/build)
step(${work}/build/fit ${SOURCE}/samples/cutters-evening/mended.toml ${work}/fitted.obj)
# C5 was read as 33.8 +- 0.1 degrees.
if(NOT out MATCHES "converged: .*C5 +33[.]7[0-9]+ [+]- 0[.][0-9]+ degrees")
  message(FATAL_ERROR "the project's fit printed '${out}'")
endif()

# Stops at the first step that fails.
set(work ${BUILD}/consumer-check)
file(REMOVE_RECURSE ${work})
macro(step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${out}")
  endif()
endmacro()
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/prefix)
step(${CMAKE_COMMAND} -S ${SOURCE} -B ${work}/build -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${work}/prefix
  -DCMAKE_BUILD_TYPE=Release)
step(${CMAKE_COMMAND} --build ${work}/build)
execute_process(COMMAND ${work}/build/consumer RESULT_VARIABLE code OUTPUT_VARIABLE out)
# Diamond's index at the D line: 2.417 (Peter 1923; see stone/data/materials.json).
if(NOT code EQUAL 0 OR NOT out MATCHES "^2\\.417")
  message(FATAL_ERROR "the consumer printed '${out}' (exit ${code})")
endif()

file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} --component libraries
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

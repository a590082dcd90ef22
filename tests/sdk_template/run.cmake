# Builds the plugin templates as a stranger would: copied elsewhere, against the installed SDK only.
#   cmake -DTEMPLATES=… -DBUILD=… -DWORK=… -DNM=… -DCXX_COMPILER=… -DC_COMPILER=… -P run.cmake
# When the build has the program, each template's tree must also run to Success.
cmake_minimum_required(VERSION 3.20)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(check_template variant plugin)
  set(folder ${WORK}/${variant})
  file(COPY ${TEMPLATES}/${variant} DESTINATION ${WORK})
  run(${CMAKE_COMMAND} -S ${folder} -B ${folder}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
      -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -DCMAKE_C_COMPILER=${C_COMPILER}
      -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_C_FLAGS=-Wall\ -Wextra\ -Werror
      -DCMAKE_CXX_FLAGS=-Wall\ -Wextra\ -Werror --no-warn-unused-cli)
  run(${CMAKE_COMMAND} --build ${folder}/build)
  run(${NM} -D --defined-only ${folder}/build/${plugin}.so)
  string(REGEX REPLACE "[0-9a-f]+ [A-Za-z] " "" symbols "${output}")
  string(STRIP "${symbols}" symbols)
  if(NOT symbols STREQUAL "lockstep_plugin_entry")
    message(FATAL_ERROR "${plugin}.so exports more or less than lockstep_plugin_entry:\n${symbols}")
  endif()
  if(EXISTS ${BUILD}/lockstep)
    run(${BUILD}/lockstep run ${folder}/tree.xml --clock virtual --plugin-path ${folder}/build)
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --component sdk --prefix ${WORK}/prefix)
check_template(cpp sweep)
check_template(c countdown)

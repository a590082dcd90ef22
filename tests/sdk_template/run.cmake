# Builds the plugin templates as a stranger would: copied elsewhere, against the installed SDK only.
#   cmake -DBUILD=… -DWORK=… -DNM=… -DCXX_COMPILER=… -DC_COMPILER=… -P run.cmake
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
  file(COPY ${WORK}/prefix/share/lockstep/template/${variant} DESTINATION ${WORK})
  run(${CMAKE_COMMAND} -S ${folder} -B ${folder}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
      -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -DCMAKE_C_COMPILER=${C_COMPILER}
      -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_C_FLAGS=-Wall\ -Wextra\ -Werror
      -DCMAKE_CXX_FLAGS=-Wall\ -Wextra\ -Werror --no-warn-unused-cli)
  if(NOT output MATCHES "so it is Release")
    message(FATAL_ERROR "a plugin without a build type is not said to be Release:\n${output}")
  endif()
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

# check_components(COMPONENTS… EXPECTED): "" when they are found, else what the message has.
function(check_components components expected)
  file(WRITE ${WORK}/components/CMakeLists.txt "cmake_minimum_required(VERSION 3.20)
project(components LANGUAGES C)
find_package(lockstep REQUIRED ${components})\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK}/components -B ${WORK}/components/build
      -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
      -DCMAKE_C_COMPILER=${C_COMPILER}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(expected STREQUAL "")
    if(NOT result EQUAL 0)
      message(FATAL_ERROR "find_package(lockstep ${components}) failed:\n${output}")
    endif()
  elseif(result EQUAL 0 OR NOT output MATCHES "${expected}")
    message(FATAL_ERROR "find_package(lockstep ${components}): expected '${expected}':\n${output}")
  endif()
endfunction()

check_components("COMPONENTS sdk" "")
check_components("OPTIONAL_COMPONENTS nonsense" "")
check_components("COMPONENTS nonsense" "no component 'nonsense'")

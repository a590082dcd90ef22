# Builds new plugins as a stranger would: elsewhere, against the installed SDK only.
#   cmake -DBUILD=… -DSANITIZED=… -DWORK=… -DNM=… -DREADELF=… -DCXX_COMPILER=… -DC_COMPILER=… -P run.cmake
# The tree of each must also run to Success.
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

# check_plugin(LANGUAGE NAME): what `lockstep new plugin` makes, built against the SDK.
function(check_plugin language plugin)
  set(folder ${WORK}/${plugin})
  run(${CMAKE_COMMAND} -E chdir ${WORK} ${BUILD}/lockstep new plugin ${plugin} --lang ${language})
  run(${CMAKE_COMMAND} -S ${folder} -B ${folder}/build -DCMAKE_PREFIX_PATH=${WORK}/prefix
      -DLOCKSTEP_PROGRAM=${BUILD}/lockstep
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
  run(${CMAKE_COMMAND} --install ${folder}/build --prefix ${folder}/installed)
  run(${BUILD}/lockstep run ${folder}/tree.xml --clock virtual --plugin-path ${folder}/installed/lib/lockstep/plugins)
  run(${BUILD}/lockstep run ${folder}/tree.xml --clock virtual --plugin-path ${folder}/build)
  run(${CMAKE_CTEST_COMMAND} --test-dir ${folder}/build)
  if(NOT output MATCHES "100% tests passed, 0 tests failed out of [1-9]")
    message(FATAL_ERROR "the scenarios of the plugin:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --component sdk --prefix ${WORK}/prefix)
# The file for pkg-config finds what is installed with it, wherever that is.
file(GLOB_RECURSE file ${WORK}/prefix/lockstep.pc)
file(STRINGS ${file} prefix REGEX "^prefix=")
get_filename_component(pcfiledir ${file} DIRECTORY)
string(REPLACE "prefix=\${pcfiledir}" "${pcfiledir}" prefix "${prefix}")
if(NOT EXISTS ${prefix}/include/lockstep/leaf.h)
  message(FATAL_ERROR "${file} names the prefix ${prefix}")
endif()
check_plugin(c++ sweep)
check_plugin(c countdown)

# build_btcpp(PREFIX OPTION…): a project for BehaviorTree.CPP, as it is.
function(build_btcpp prefix)
  file(REMOVE_RECURSE ${WORK}/btcpp)
  file(COPY ${SOURCE}/btcpp DESTINATION ${WORK})
  run(${CMAKE_COMMAND} -S ${WORK}/btcpp -B ${WORK}/btcpp/build -DCMAKE_PREFIX_PATH=${prefix}
      -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
      -DCMAKE_CXX_FLAGS=-Wall\ -Wextra\ -Werror ${ARGN})
  run(${CMAKE_COMMAND} --build ${WORK}/btcpp/build)
endfunction()

build_btcpp(${WORK}/prefix -DWITH_PROGRAM=OFF)
if(EXISTS ${BUILD}/lockstep)
  run(${BUILD}/lockstep run ${WORK}/btcpp/tree.xml --clock virtual
      --plugin ${WORK}/btcpp/build/librobot_nodes.so)
  if(NOT output MATCHES "hello, robot")
    message(FATAL_ERROR "the nodes for BehaviorTree.CPP printed:\n${output}")
  endif()
endif()

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
check_components("COMPONENTS runtime" "only the SDK of lockstep is installed here")

# Programs that tick trees, against all of lockstep. It is found where it is moved to.
if(EXISTS ${BUILD}/liblockstep-runtime.so AND NOT SANITIZED)
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/installed)
  file(RENAME ${WORK}/installed ${WORK}/moved)
  file(COPY ${WORK}/moved/share/lockstep/examples DESTINATION ${WORK})
  run(${CMAKE_COMMAND} -S ${WORK}/examples -B ${WORK}/examples/build
      -DCMAKE_PREFIX_PATH=${WORK}/moved -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
      -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
      -DCMAKE_C_FLAGS=-Wall\ -Wextra\ -Werror\ -std=c99 -DCMAKE_CXX_FLAGS=-Wall\ -Wextra\ -Werror)
  run(${CMAKE_COMMAND} --build ${WORK}/examples/build)
  set(trees ${WORK}/moved/share/lockstep/trees)
  run(${WORK}/examples/build/own_loop)
  if(NOT output MATCHES "success: left at 0.7")
    message(FATAL_ERROR "own_loop printed:\n${output}")
  endif()
  run(${WORK}/examples/build/many_runs ${trees}/door_pulling.xml)
  if(NOT output MATCHES "1000 of 1000 runs succeeded")
    message(FATAL_ERROR "many_runs printed:\n${output}")
  endif()
  run(${WORK}/examples/build/in_c ${trees}/door_pulling.xml)
  if(NOT output MATCHES "100 %\nsuccess")
    message(FATAL_ERROR "in_c printed:\n${output}")
  endif()
  run(${CMAKE_COMMAND} -E env --unset=LOCKSTEP PYTHONPATH=${WORK}/moved/share/lockstep/python
      PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c
      "from lockstep import *\nprint(library(), Tree('${trees}/door_pulling.xml').run())")
  if(NOT output MATCHES "^${WORK}/moved/lib.*<lockstep run: success after 701 ticks>")
    message(FATAL_ERROR "the package for Python printed:\n${output}")
  endif()
  file(GLOB library ${WORK}/moved/lib*/liblockstep-runtime.so ${WORK}/moved/lib/*/liblockstep-runtime.so)
  run(${NM} -D --defined-only ${library})
  string(REGEX REPLACE "[0-9a-f]+ [A-Za-z] lockstep_[a-z0-9_]+\n" "" others "${output}")
  if(NOT others STREQUAL "")
    message(FATAL_ERROR "liblockstep-runtime.so exports more than its functions:\n${others}")
  endif()

  build_btcpp(${WORK}/moved)
  run(${WORK}/btcpp/build/robot ${WORK}/btcpp/build/librobot_nodes.so)
  string(CONCAT expected "Say\nhello, world\nSUCCESS after 3, at 3\nSay\nhello, world\n"
         "SUCCESS at 2\ncounter halted\nrefused\n")
  if(NOT output STREQUAL expected)
    message(FATAL_ERROR "the program for BehaviorTree.CPP printed:\n${output}")
  endif()
  # Its functions come from liblockstep-btcpp.a: a source compiles few of the headers.
  file(GLOB object ${WORK}/btcpp/build/CMakeFiles/robot.dir/main.cpp.o)
  run(${NM} ${object})
  string(REGEX MATCHALL " W " functions "${output}")
  list(LENGTH functions count)
  if(count GREATER 1500)
    message(FATAL_ERROR "a program for BehaviorTree.CPP compiles ${count} functions of headers in one source: which "
                        "can be in plugins/sdk/btcpp/compiled instead? tests/btcpp/compile_times.py has the time")
  endif()
  # With the headers alone, the plugin loads at each level of optimization, and can be isolated.
  foreach(level O0 O2 O3)
    run(${CXX_COMPILER} -std=c++17 -${level} -shared -fPIC -DBT_PLUGIN_EXPORT
        -I${WORK}/moved/include -I${WORK}/moved/include/lockstep-btcpp
        ${WORK}/btcpp/nodes.cpp -o ${WORK}/btcpp/alone.so)
    foreach(option --on-fault=fail --isolate)
      run(${BUILD}/lockstep run ${WORK}/btcpp/tree.xml --clock virtual --plugin ${WORK}/btcpp/alone.so ${option})
    endforeach()
  endforeach()
  # The plugin does not need the runtime.
  run(${READELF} -d ${WORK}/btcpp/build/librobot_nodes.so)
  if(output MATCHES "lockstep-runtime")
    message(FATAL_ERROR "a plugin with nodes for BehaviorTree.CPP needs liblockstep-runtime.so:\n${output}")
  endif()
endif()

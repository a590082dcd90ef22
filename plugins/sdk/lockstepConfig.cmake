# find_package(lockstep): the target lockstep::sdk, for plugins, with the function
# lockstep_add_plugin; and, where all of lockstep is installed, lockstep::runtime, for programs that
# tick trees themselves.
foreach(component IN LISTS lockstep_FIND_COMPONENTS)
  if(component STREQUAL "sdk")
    set(lockstep_sdk_FOUND ON)
  elseif(component STREQUAL "runtime" AND EXISTS ${CMAKE_CURRENT_LIST_DIR}/lockstepRuntimeTargets.cmake)
    set(lockstep_runtime_FOUND ON)
  elseif(lockstep_FIND_REQUIRED_${component})
    set(lockstep_FOUND OFF)
    if(component STREQUAL "runtime")
      set(lockstep_NOT_FOUND_MESSAGE "only the SDK of lockstep is installed here, without 'runtime'")
    else()
      set(lockstep_NOT_FOUND_MESSAGE
          "lockstep has no component '${component}'; it has 'sdk' and 'runtime'")
    endif()
    return()
  endif()
endforeach()
include(CMakeFindDependencyMacro)
find_dependency(Threads)
include(${CMAKE_CURRENT_LIST_DIR}/lockstepTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/lockstepRuntimeTargets.cmake OPTIONAL)
# The functions of the headers for BehaviorTree.CPP, compiled, where all of lockstep is installed: for
# plugins, which do not need the runtime, and with it. A debug mode of the standard library has other
# classes, so the headers do not use them then.
set(_lockstep_functions ${CMAKE_CURRENT_LIST_DIR}/../../liblockstep-btcpp.a)
if(TARGET lockstep::runtime AND EXISTS ${_lockstep_functions} AND NOT TARGET lockstep::btcpp_functions)
  add_library(lockstep::btcpp_functions STATIC IMPORTED)
  add_library(lockstep::btcpp_program_functions STATIC IMPORTED)
  set_target_properties(lockstep::btcpp_functions lockstep::btcpp_program_functions PROPERTIES
    IMPORTED_LOCATION ${_lockstep_functions})
  set_target_properties(lockstep::btcpp_program_functions PROPERTIES
    INTERFACE_LINK_LIBRARIES lockstep::runtime)
  set_property(TARGET lockstep::btcpp APPEND PROPERTY
    INTERFACE_COMPILE_DEFINITIONS LOCKSTEP_BTCPP_LIBRARY)
  set_property(TARGET lockstep::btcpp APPEND PROPERTY INTERFACE_LINK_LIBRARIES
    $<IF:$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>,lockstep::btcpp_program_functions,lockstep::btcpp_functions>)
endif()
unset(_lockstep_functions)
# The program, where it is installed or built beside this; LOCKSTEP_PROGRAM-NOTFOUND where only the SDK is.
find_program(LOCKSTEP_PROGRAM lockstep
  HINTS ${CMAKE_CURRENT_LIST_DIR}/../.. ${CMAKE_CURRENT_LIST_DIR}/../../../bin ${CMAKE_CURRENT_LIST_DIR}/../../../../bin)
include(${CMAKE_CURRENT_LIST_DIR}/lockstep_add_plugin.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/lockstep_add_tree_tests.cmake)

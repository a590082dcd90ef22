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
include(${CMAKE_CURRENT_LIST_DIR}/lockstep_add_plugin.cmake)

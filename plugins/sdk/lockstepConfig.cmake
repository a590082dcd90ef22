# find_package(lockstep): the target lockstep::sdk and the function lockstep_add_plugin.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
include(${CMAKE_CURRENT_LIST_DIR}/lockstepTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/lockstep_add_plugin.cmake)

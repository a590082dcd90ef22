# find_package(behaviortree_cpp) where the prefix of lockstep is asked first: nodes written for that
# library become plugins of lockstep, with their CMakeLists.txt as it is. docs/btcpp.md.
include(CMakeFindDependencyMacro)
find_dependency(lockstep PATHS ${CMAKE_CURRENT_LIST_DIR}/../lockstep NO_DEFAULT_PATH)

if(NOT TARGET behaviortree_cpp::behaviortree_cpp)
  add_library(behaviortree_cpp::behaviortree_cpp INTERFACE IMPORTED)
  target_link_libraries(behaviortree_cpp::behaviortree_cpp INTERFACE lockstep::btcpp)
  # For programs that tick trees. A plugin does not use it, and so does not need it.
  if(TARGET lockstep::runtime)
    target_link_options(behaviortree_cpp::behaviortree_cpp INTERFACE LINKER:--as-needed)
    if(TARGET lockstep::btcpp_program_functions)
      target_link_libraries(behaviortree_cpp::behaviortree_cpp INTERFACE lockstep::btcpp_program_functions)
    endif()
    target_link_libraries(behaviortree_cpp::behaviortree_cpp INTERFACE lockstep::runtime)
  endif()
  add_library(BT::behaviortree_cpp ALIAS behaviortree_cpp::behaviortree_cpp)
  add_library(behaviortree_cpp ALIAS behaviortree_cpp::behaviortree_cpp)
endif()

set(behaviortree_cpp_LIBRARIES behaviortree_cpp::behaviortree_cpp)
set(behaviortree_cpp_TARGETS behaviortree_cpp::behaviortree_cpp)
get_target_property(behaviortree_cpp_INCLUDE_DIRS lockstep::btcpp_headers INTERFACE_INCLUDE_DIRECTORIES)

# lockstep_add_plugin(name source…) builds the plugin name.so, in C or C++, with everything hidden
# but lockstep_plugin_entry. Used by the plugins of this repository and, installed, by all others.
# A project that chooses no build type would run its leaves unoptimized: then the plugin, and nothing
# else of the project, is as in Release.
# In a project that has found lockstep, it is installed in lib/lockstep/plugins, where colcon's prefixes have plugins.
# With BTCPP among the sources, these are written for BehaviorTree.CPP: docs/btcpp.md.
function(lockstep_add_plugin name)
  set(sources ${ARGN})
  set(sdk lockstep::sdk)
  if("BTCPP" IN_LIST sources)
    list(REMOVE_ITEM sources BTCPP)
    set(sdk lockstep::btcpp)
  endif()
  add_library(${name} MODULE ${sources})
  target_link_libraries(${name} PRIVATE ${sdk})
  if(sdk STREQUAL "lockstep::btcpp")
    target_compile_definitions(${name} PRIVATE BT_PLUGIN_EXPORT)
  endif()
  get_property(several_configurations GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  if(NOT CMAKE_BUILD_TYPE AND NOT several_configurations)
    message(STATUS "lockstep: no CMAKE_BUILD_TYPE is given for ${name}, so it is Release")
    target_compile_options(${name} PRIVATE -O3 -DNDEBUG)
  endif()
  get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
  if("CXX" IN_LIST languages)
    target_compile_features(${name} PRIVATE cxx_std_17)
  endif()
  set(exports ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/lockstep_plugin.map)
  target_link_options(${name} PRIVATE LINKER:--version-script=${exports})
  set_target_properties(${name} PROPERTIES
    PREFIX "" SUFFIX .so LINK_DEPENDS ${exports}
    C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(lockstep_FOUND)
    install(TARGETS ${name} LIBRARY DESTINATION lib/lockstep/plugins)
  endif()
endfunction()

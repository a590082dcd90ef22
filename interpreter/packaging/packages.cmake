# What is installed and in which Debian package: see docs/packages.md. `./dev package` makes them.
# With LOCKSTEP_PACKAGES, files go where Debian wants them, and interpreter/packaging/build.sh makes the packages.
if(LOCKSTEP_TOOLS)
  set(generated ${CMAKE_BINARY_DIR}/generated)
  # The program writes them: in a build for another machine, its emulator runs it.
  install(CODE "
    set(program ${CMAKE_CROSSCOMPILING_EMULATOR} \"$<TARGET_FILE:lockstep>\")
    file(REMOVE_RECURSE \"${generated}\")
    execute_process(COMMAND \${program} manual \"${generated}/man\" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
    foreach(shell bash zsh fish)
      execute_process(COMMAND \${program} completion \${shell} OUTPUT_FILE \"${generated}/\${shell}\"
                      COMMAND_ERROR_IS_FATAL ANY)
    endforeach()
    if(\"${LOCKSTEP_PACKAGES}\" STREQUAL \"ON\")
      file(GLOB pages \"${generated}/man/*/*\")
      execute_process(COMMAND gzip -9n \${pages} COMMAND_ERROR_IS_FATAL ANY)
    endif()")
  install(DIRECTORY ${generated}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR})
  install(FILES ${generated}/bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME lockstep)
  install(FILES ${generated}/zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _lockstep)
  install(FILES ${generated}/fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d RENAME lockstep.fish)
endif()

# Relative to the file itself, since `cmake --install --prefix` comes after it was written.
file(RELATIVE_PATH prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig "${prefix_from_pkgconfig}")
foreach(part lockstep lockstep-runtime)
  configure_file(interpreter/packaging/${part}.pc.in ${CMAKE_BINARY_DIR}/${part}.pc @ONLY)
endforeach()
install(FILES ${CMAKE_BINARY_DIR}/lockstep.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT sdk)
install(FILES ${CMAKE_BINARY_DIR}/lockstep-runtime.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT runtime_dev)
if(NOT LOCKSTEP_PACKAGES)
  return()
endif()

# The module, and what tells pytest of the plugin.
set(modules lib/python3/dist-packages)
set(information ${modules}/lockstep-${PROJECT_VERSION}.dist-info)
install(DIRECTORY plugins/sdk/python/lockstep DESTINATION ${modules} COMPONENT python PATTERN __pycache__ EXCLUDE)
file(CREATE_LINK ../../../share/lockstep/python/lockstep_leaf.py ${CMAKE_BINARY_DIR}/lockstep_leaf.py SYMBOLIC)
install(FILES ${CMAKE_BINARY_DIR}/lockstep_leaf.py DESTINATION ${modules} COMPONENT python)
file(WRITE ${CMAKE_BINARY_DIR}/METADATA
     "Metadata-Version: 2.1\nName: lockstep\nVersion: ${PROJECT_VERSION}\nSummary: ${PROJECT_DESCRIPTION}\n")
file(WRITE ${CMAKE_BINARY_DIR}/entry_points.txt "[pytest11]\nlockstep = lockstep.pytest_plugin\n")
install(FILES ${CMAKE_BINARY_DIR}/METADATA ${CMAKE_BINARY_DIR}/entry_points.txt DESTINATION ${information} COMPONENT python)

install(FILES interpreter/packaging/lockstep@.service DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/lockstep/examples)

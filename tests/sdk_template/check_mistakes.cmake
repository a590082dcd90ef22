# check_mistakes(last flag…) compiles SOURCE without a mistake and then with each one, up to `last`: the
# compiler must say all that is in the lists said_1, said_2, …
macro(check_mistakes last)
  foreach(mistake RANGE ${last})
    execute_process(
      COMMAND ${CXX_COMPILER} -std=c++17 -fsyntax-only ${ARGN} -DMISTAKE=${mistake} ${SOURCE}
      RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(mistake EQUAL 0 AND NOT result EQUAL 0)
      message(FATAL_ERROR "the source without a mistake is refused:\n${output}")
    elseif(mistake GREATER 0 AND result EQUAL 0)
      message(SEND_ERROR "mistake ${mistake} compiles")
    endif()
    foreach(said IN LISTS said_${mistake})
      if(NOT output MATCHES "${said}")
        message(SEND_ERROR "mistake ${mistake}: '${said}' is not in\n${output}")
      endif()
    endforeach()
  endforeach()
endmacro()

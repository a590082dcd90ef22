# compile(flag…) compiles SOURCE without a mistake, which must succeed.
macro(compile)
  execute_process(COMMAND ${CXX_COMPILER} -std=c++17 -fsyntax-only -DMISTAKE=0 ${ARGN} ${SOURCE}
                  RESULT_VARIABLE result ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "the source without a mistake is refused:\n${output}")
  endif()
endmacro()

# compile_mistake(number flag…) compiles it with one, which must fail.
macro(compile_mistake number)
  execute_process(COMMAND ${CXX_COMPILER} -std=c++17 -fsyntax-only -DMISTAKE=${number} ${ARGN} ${SOURCE}
                  RESULT_VARIABLE result ERROR_VARIABLE output)
  if(result EQUAL 0)
    message(SEND_ERROR "mistake ${number} compiles")
  endif()
endmacro()

# The compiler must have said all that is in the list said_… of this mistake.
macro(check_said mistake)
  foreach(said IN LISTS said_${mistake})
    if(NOT output MATCHES "${said}")
      message(SEND_ERROR "mistake ${mistake}: '${said}' is not in\n${output}")
    endif()
  endforeach()
endmacro()

# check_mistakes(last flag…) compiles SOURCE without a mistake and then with each one, up to `last`. What it
# includes at its beginning is compiled once.
macro(check_mistakes last)
  file(READ ${SOURCE} text)
  string(REGEX MATCH "(#include [^\n]*\n+)+" includes "${text}")
  set(prelude ${CMAKE_CURRENT_BINARY_DIR}/mistakes_prelude.hpp)
  file(WRITE ${prelude} "${includes}")
  execute_process(COMMAND ${CXX_COMPILER} -std=c++17 ${ARGN} -x c++-header ${prelude} -o ${prelude}.gch)
  compile(${ARGN} -include ${prelude})
  foreach(mistake RANGE 1 ${last})
    compile_mistake(${mistake} ${ARGN} -include ${prelude})
    check_said(${mistake})
  endforeach()
endmacro()

# The same with all mistakes at once: for headers that take seconds, and mistakes that no words are said of twice.
macro(check_mistakes_at_once last)
  compile(${ARGN})
  compile_mistake(-1 ${ARGN})
  foreach(mistake RANGE 1 ${last})
    check_said(${mistake})
  endforeach()
endmacro()

#!/usr/bin/env bash
# compilers.sh SOURCES: the headers for plugins and for programs that run trees, without a warning, with each g++ and clang
# that is here, in each C++ from 17, and in C. SUPPORT.md has the compilers with which it was run.
set -euo pipefail
cd "$1"
shopt -s nullglob
flags=(-fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror -Iplugins/sdk -Iinterpreter/embedding)
tried=0
declare -A seen=()
# is_new COMPILER: no other name of one that was tried.
is_new() {
  local real
  real=$(realpath "$1")
  [ -x "$real" ] && [ -z "${seen[$real]:-}" ] && seen[$real]=yes
}
# try_with COMPILER LANGUAGE STANDARD HEADER…
try_with() {
  local includes=() compiler=$1 language=$2 standard=$3
  shift 3
  for header in "$@"; do includes+=(-include "$header"); done
  "$compiler" "${flags[@]}" "-std=$standard" "${includes[@]}" -x "$language" /dev/null ||
    { echo "$compiler -std=$standard $*" >&2 && exit 1; }
  tried=$((tried + 1))
}
for compiler in /usr/bin/{g++,clang++} /usr/bin/{g++,clang++}-[0-9]*; do
  is_new "$compiler" || continue
  for standard in c++17 c++20 c++2b; do
    try_with "$compiler" c++ "$standard" lockstep/leaf.hpp lockstep/ext/clock.h
    try_with "$compiler" c++ "$standard" lockstep/runtime.hpp lockstep/testing.hpp
  done
  # With a sanitizer, g++ takes less for a constant.
  "$compiler" "${flags[@]}" -std=c++17 -fsanitize=undefined tests/abi/plugins/shapes_sdk.cpp
done
seen=()
for compiler in /usr/bin/{gcc,clang} /usr/bin/{gcc,clang}-[0-9]*; do
  is_new "$compiler" || continue
  for standard in c99 c17; do try_with "$compiler" c "$standard" lockstep/leaf.h lockstep/clock.h lockstep/runtime.h; done
  # An extension may come first, and old names stay.
  for header in children object place; do try_with "$compiler" c c99 "lockstep/ext/$header.h" lockstep/ticks.h; done
done
echo "$tried combinations compile"
[ $tried -gt 0 ]

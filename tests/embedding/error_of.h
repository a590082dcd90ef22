// What a program gets where a call fails.
#pragma once

#include <lockstep/runtime.hpp>
#include <string>

// The text of the error that it throws.
template <class Work>
std::string error_of(Work work) {
  try {
    work();
  } catch (const lockstep::runtime::Error& error) {
    return error.what();
  }
  return "no error";
}

// The name of a type as it is written.
#pragma once

#include <cxxabi.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <typeindex>
#include <typeinfo>

namespace BT {

inline std::string demangle(const char* name) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(
      abi::__cxa_demangle(name, nullptr, nullptr, &status), std::free);
  return status == 0 && text ? text.get() : name;
}
inline std::string demangle(const std::type_index& index) {
  return index == typeid(std::string) ? "std::string" : demangle(index.name());
}
inline std::string demangle(const std::type_info& info) {
  return demangle(std::type_index(info));
}

}  // namespace BT

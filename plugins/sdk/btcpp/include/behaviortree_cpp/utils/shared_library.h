// The names of shared objects.
#pragma once

#include <string>

namespace BT {

class SharedLibrary {
 public:
  static const char* prefix() { return "lib"; }
  static const char* suffix() { return ".so"; }
  static std::string getOSName(const std::string& name) { return prefix() + name + suffix(); }
};

}  // namespace BT

#include "base/system/late_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

namespace lockstep::host {

LateLibrary::LateLibrary(const char* file) : file_(file), handle_(dlopen(file, RTLD_NOW)) {
  if (handle_ == nullptr) {
    throw std::runtime_error(fmt::format("the library {} cannot be loaded: {}", file, dlerror()));
  }
}

LateLibrary::Function LateLibrary::function(const char* name) const {
  void* const address = dlsym(handle_, name);
  if (address == nullptr) {
    throw std::runtime_error(fmt::format("the library {} has no {}", file_, name));
  }
  return Function(address);
}

}  // namespace lockstep::host

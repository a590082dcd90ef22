// Shared objects: their names, and what is in one.
#pragma once

#include <dlfcn.h>

#include <string>

#include "behaviortree_cpp/exceptions.h"

namespace BT {

// It stays open when this goes, as the nodes of a plugin need it.
class SharedLibrary {
 public:
  SharedLibrary() = default;
  explicit SharedLibrary(const std::string& path, int flags = 0) { load(path, flags); }

  static std::string prefix() { return "lib"; }
  static std::string suffix() { return ".so"; }
  static std::string getOSName(const std::string& name) { return prefix() + name + suffix(); }

  void load(const std::string& path, int /*flags*/ = 0) {
    if (isLoaded()) throw RuntimeError("Library already loaded: ", path);
    handle_ = dlopen(path.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (!isLoaded()) throw RuntimeError("Could not load library: ", dlerror());
    path_ = path;
  }
  void unload() {
    if (isLoaded()) dlclose(handle_);
    handle_ = nullptr;
  }
  bool isLoaded() const { return handle_ != nullptr; }
  const std::string& getPath() const { return path_; }

  bool hasSymbol(const std::string& name) const { return find(name) != nullptr; }
  void* getSymbol(const std::string& name) const {
    void* const symbol = find(name);
    if (symbol == nullptr)
      throw RuntimeError("[SharedLibrary::getSymbol]: can't find symbol ", name);
    return symbol;
  }

 private:
  void* find(const std::string& name) const {
    return isLoaded() ? dlsym(handle_, name.c_str()) : nullptr;
  }

  void* handle_ = nullptr;
  std::string path_;
};

}  // namespace BT

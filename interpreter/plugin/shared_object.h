// Opens a shared object and finds the constant that it exports. Knows ELF and the dynamic linker,
// nothing of plugins.
#pragma once

#include <cstddef>
#include <string>

#include "core/problem.h"
#include "plugin/call_mark.h"

namespace lockstep {

struct SharedObject {
  void* handle = nullptr;
};

// What the linker would refuse in words that help nobody (or would crash on) is found beforehand:
// a file that is missing, not a shared object, for another machine, or cut off.
[[nodiscard]] Result<SharedObject> open_shared_object(const std::string& path);

// Those that this process has opened so far, in one name, as the culprit of what they do at the end
// of a thread or the process; null: none.
const CallSite* opened_shared_objects();

struct ExportedConstant {
  const void* address = nullptr;
  std::size_t size = 0;  // as the symbol table says; 0 = it does not say
};

[[nodiscard]] Result<ExportedConstant> find_constant(const SharedObject& object,
                                                     const char* symbol);

}  // namespace lockstep

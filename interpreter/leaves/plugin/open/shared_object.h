// Opens a shared object and finds the constant that it exports. Knows ELF and the dynamic linker,
// nothing of plugins.
#pragma once

#include <cstddef>
#include <string>

#include "base/core/problem.h"
#include "base/system/call_mark.h"

namespace lockstep::host {

struct SharedObject {
  void* handle = nullptr;
};

// Checks first what the linker reports unclearly (or crashes on): a file that is missing, not a
// shared object, for another machine, or cut off.
[[nodiscard]] Result<SharedObject> open_shared_object(const std::string& path);

// Those that this process has opened so far, in one name, as the culprit of what they do at the end
// of a thread or the process; null: none.
const CallSite* opened_shared_objects();

struct ExportedConstant {
  const void* address = nullptr;
  std::size_t size = 0;  // from the symbol table; 0 = unknown
};

[[nodiscard]] Result<ExportedConstant> find_constant(const SharedObject& object,
                                                     const char* symbol);

}  // namespace lockstep::host

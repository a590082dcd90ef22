// Opens a shared object and finds the constant that it exports. Knows ELF and the dynamic linker,
// nothing of plugins.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "plugin/call_mark.h"
#include "plugin/refusal.h"

namespace lockstep {

struct SharedObject {
  void* handle = nullptr;
};

// What the linker would refuse in words that help nobody (or would crash on) is found beforehand:
// a file that is missing, not a shared object, for another machine, or cut off.
std::optional<Refusal> open_shared_object(const std::string& path, SharedObject& object);

// Those that this process has opened so far, in one name, as the culprit of what they do at the end
// of a thread or the process; null: none.
const CallSite* opened_shared_objects();

struct ExportedConstant {
  const void* address = nullptr;
  std::size_t size = 0;  // as the symbol table says; 0 = it does not say
};

std::optional<Refusal> find_constant(const SharedObject& object, const char* symbol,
                                     ExportedConstant& found);

}  // namespace lockstep

// The types of objects that plugins declare, checked and translated.
#pragma once

#include "base/core/object.h"
#include "base/core/problem.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// A declaration that stands for a type of another process: its retain is `mark`.
struct HostedObjectType : lockstep_object_type {
  static void mark(void* /*object*/) {}
  const ObjectType* type = nullptr;
};

// The same for the same declaration; lives until the process ends, or as long as the type that a
// HostedObjectType has. `plugin` is the name of its plugin. The message says what is wrong with
// "it".
Result<const ObjectType*> read_object_type(const lockstep_object_type* declared,
                                           std::string_view plugin);

}  // namespace lockstep::host

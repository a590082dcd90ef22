// The types of objects that plugins declare, checked and translated.
#pragma once

#include "core/object.h"
#include "core/problem.h"
#include "lockstep/leaf.h"

namespace lockstep {

// The same for the same declaration; lives until the process ends. The message says what is wrong
// with "it".
Result<const ObjectType*> read_object_type(const lockstep_object_type* declared);

}  // namespace lockstep

/* lockstep/ext/changes.h: whether a port has another value than before, whatever its type is. Found
 * with lockstep_host::get_extension(LOCKSTEP_CHANGES). C++ authors want
 * Input<lockstep::Any> of lockstep/leaf.hpp. */
#ifndef LOCKSTEP_EXT_CHANGES_H
#define LOCKSTEP_EXT_CHANGES_H

#include "lockstep/leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lockstep_changes {
  uint32_t struct_size; /* sizeof(lockstep_changes) as the host knew it */
  /* [run] Whether the port has another value than at the last call for it; at the first call,
   * whether it has one. No value is a value here. Two objects differ, also where they look alike. A
   * port that is bound to no entry has not changed. */
  bool (*changed)(const lockstep_caller* caller, uint32_t port);
} lockstep_changes;

#define LOCKSTEP_CHANGES "lockstep.changes"

#ifdef __cplusplus
}
#endif

#endif

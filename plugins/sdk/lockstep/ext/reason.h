/* lockstep/ext/reason.h: why a leaf fails, and what it waits for. */
#ifndef LOCKSTEP_EXT_REASON_H
#define LOCKSTEP_EXT_REASON_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* For leaves that explain their results. Found with get_extension(LOCKSTEP_REASON). */
typedef struct lockstep_reason {
  uint32_t struct_size;

  /* [run] In a function of a leaf: why the result of this tick is what it is. With failure, the
   * reason: "no object at (0.3, 1.2)". With running, what the leaf waits for: "force 3 of 10 N".
   * It belongs to this tick: a leaf that waits on says so again. The last text of a tick is kept:
   * its first 500 bytes are copied, the rest is counted. NULL or "": none. */
  void (*say)(const lockstep_caller* caller, const char* text);
} lockstep_reason;

#define LOCKSTEP_REASON "lockstep.reason"

#ifdef __cplusplus
}
#endif

#endif

/* lockstep/ext/behavior.h: what a leaf type declares about what it does. */
#ifndef LOCKSTEP_EXT_BEHAVIOR_H
#define LOCKSTEP_EXT_BEHAVIOR_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One statement about what an action or a condition does, in the words of a leaf model:
 * {"ticks", "2..40"}. The words are result, ticks, ends, progress, step, finish, held, writes and
 * out.PORT, each at most once; docs/verify.md defines them. `lockstep verify` relies on them
 * where no leaf model declares otherwise. */
struct lockstep_behavior {
  const char* word;
  const char* value;
};

#ifdef __cplusplus
}
#endif

#endif

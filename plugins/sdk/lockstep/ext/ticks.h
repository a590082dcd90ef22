/* lockstep/ext/ticks.h: the number of a tick, by which a node knows whether it was ticked in the
 * tick before. Found with lockstep_host::get_extension(LOCKSTEP_TICKS). C++ authors want
 * tick_number() of lockstep/leaf.hpp. */
#ifndef LOCKSTEP_EXT_TICKS_H
#define LOCKSTEP_EXT_TICKS_H

#include "lockstep/leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lockstep_ticks {
  uint32_t struct_size; /* sizeof(lockstep_ticks) as the host knew it */
  /* [run] The number of the current tick. The next one has the next number, also if it is late
   * and some were left out for it. In a separate process: the whole periods since the run began. */
  uint64_t (*number)(const lockstep_caller* caller);
} lockstep_ticks;

#define LOCKSTEP_TICKS "lockstep.ticks"

#ifdef __cplusplus
}
#endif

#endif

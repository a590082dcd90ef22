/* lockstep/ext/clock.h: a clock that a plugin has, for `lockstep run --clock NAME`; such as the
 * simulated time of a robot's simulator. Found with lockstep_plugin::get_extension(LOCKSTEP_CLOCK).
 * Not of a plugin in a separate process. */
#ifndef LOCKSTEP_EXT_CLOCK_H
#define LOCKSTEP_EXT_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lockstep_clock {
  uint32_t struct_size; /* sizeof(lockstep_clock) as the plugin knew it */
  const char* name;     /* the NAME of --clock: "ros" */
  /* [load] After init, before the run: it begins to listen. False: *why is the reason. */
  bool (*open)(const char** why);
  /* [any] Nanoseconds, from where the clock likes; negative while it has no time. It may stand, and
   * it may jump, also back: a run then continues from the last time. */
  int64_t (*now)(void);
} lockstep_clock;

#define LOCKSTEP_CLOCK "lockstep.clock"

#ifdef __cplusplus
}
#endif

#endif

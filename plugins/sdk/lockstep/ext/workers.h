/* lockstep/ext/workers.h: threads of leaves on the virtual clock. */
#ifndef LOCKSTEP_EXT_WORKERS_H
#define LOCKSTEP_EXT_WORKERS_H

#include "../leaf.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Threads of leaves on the virtual clock, where time jumps from tick to tick. Such a
 * thread is a worker: it takes turns with the ticks and with other workers, so that a run is the
 * same every time. In its turn it may do what it likes, but the run waits for it. Its turn ends
 * when it waits for a time of the run, or ends. Found with get_extension(LOCKSTEP_WORKERS).
 *
 * A worker has a turn in the first tick at or after the time that it waits for, and one at the end
 * of the tick in which it began or was woken. Workers have their turns in the order in which they
 * began. A worker must not wait for another one by other means. */
typedef struct lockstep_worker lockstep_worker;
typedef struct lockstep_workers {
  uint32_t struct_size;

  /* [run] A new worker of the leaf. NULL when the run is not on the virtual clock, where threads
   * work in real time, as they like; and after an error. Valid until finish returns. */
  lockstep_worker* (*begin)(const lockstep_caller* caller);
  /* [run] Gives the worker turns until it has ended. Each worker must be finished. */
  void (*finish)(lockstep_worker* worker);

  /* The next four: by the thread that is the worker. */
  /* Its first call: waits for the first turn. */
  void (*start)(lockstep_worker* worker);
  /* Ends the turn. Returns true when it is `until`, in seconds since the run began; false when it
   * was woken before. Infinity: until it is woken. */
  bool (*wait)(lockstep_worker* worker, double until);
  /* Its last call. */
  void (*end)(lockstep_worker* worker);
  /* Seconds since the run began; stays the same within a turn. */
  double (*now)(lockstep_worker* worker);

  /* [any] Ends the wait, at its next turn. */
  void (*wake)(lockstep_worker* worker);
} lockstep_workers;

#define LOCKSTEP_WORKERS "lockstep.workers"

#ifdef __cplusplus
}
#endif

#endif

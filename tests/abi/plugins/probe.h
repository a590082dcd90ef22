/* A well-behaved leaf in C that logs each of its calls. The files beside this one include it,
 * define what they get wrong, and include entry.h, which makes a plugin of it. Valid C99 and C++17.
 */
#ifndef LOCKSTEP_TESTS_PROBE_H
#define LOCKSTEP_TESTS_PROBE_H

#include <stdlib.h>

#include "lockstep/leaf.h"

typedef struct probe {
  const lockstep_host* host;
  const lockstep_caller* caller;
  int64_t ticks;
} probe;

static inline void probe_log(const void* leaf, const char* what) {
  const probe* self = (const probe*)leaf;
  self->host->log(self->caller, LOCKSTEP_LOG_INFO, what);
}

static inline void probe_fail(const void* leaf, const char* message) {
  const probe* self = (const probe*)leaf;
  self->host->set_error(self->caller, message);
}

static inline void* probe_create(const lockstep_host* host, const lockstep_caller* caller,
                                 void* run_context) {
  probe* self = (probe*)malloc(sizeof(probe));
  (void)run_context;
  self->host = host;
  self->caller = caller;
  self->ticks = 0;
  probe_log(self, "create");
  return self;
}

static inline void probe_destroy(void* leaf) {
  probe_log(leaf, "destroy");
  free(leaf);
}

static inline void probe_start(void* leaf) {
  ((probe*)leaf)->ticks = 0;
  probe_log(leaf, "start");
}

/* Runs for as many ticks as its port says. */
static inline lockstep_status probe_tick(void* leaf) {
  probe* self = (probe*)leaf;
  int64_t wanted = 0;
  probe_log(leaf, "tick");
  self->host->get_int(self->caller, 0, &wanted);
  return ++self->ticks < wanted ? LOCKSTEP_RUNNING : LOCKSTEP_SUCCESS;
}

static inline void probe_halt(void* leaf) {
  probe_log(leaf, "halt");
}

#endif

/* An action that logs a line of each level in each of its ticks; it succeeds in the 300th. */
#include "probe.h"

static lockstep_status tick(void* leaf) {
  probe* self = (probe*)leaf;
  self->host->log(self->caller, LOCKSTEP_LOG_DEBUG, "thinks");
  self->host->log(self->caller, LOCKSTEP_LOG_INFO, "works");
  self->host->log(self->caller, LOCKSTEP_LOG_WARNING, "worries");
  return ++self->ticks == 300 ? LOCKSTEP_SUCCESS : LOCKSTEP_RUNNING;
}
#define LEAF_TICK tick
#include "entry.h"

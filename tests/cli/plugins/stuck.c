/* An action that never comes back from its tick; it says so, and again after each signal. */
#define _POSIX_C_SOURCE 200809L
#include <unistd.h>

#include "probe.h"

static lockstep_status tick(void* leaf) {
  (void)leaf;
  while (write(STDERR_FILENO, "stuck\n", 6) == 6) pause();
  return LOCKSTEP_FAILURE;
}
#define LEAF_TICK tick
#include "entry.h"

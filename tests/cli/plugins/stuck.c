/* An action that never comes back from its tick, whatever signals come; it says so again and again,
   on stderr or the descriptor STUCK_FILE. */
#define _POSIX_C_SOURCE 200809L
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "probe.h"

static lockstep_status tick(void* leaf) {
  const struct timespec a_while = {0, 10000000};
  const char* const file = getenv("STUCK_FILE");
  const int out = file == NULL ? STDERR_FILENO : atoi(file);
  (void)leaf;
  while (write(out, "stuck\n", 6) == 6) nanosleep(&a_while, NULL);
  return LOCKSTEP_FAILURE;
}
#define LEAF_TICK tick
#include "entry.h"

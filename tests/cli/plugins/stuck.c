/* An action that never comes back from its tick; it says so, and again after each signal. */
#define _POSIX_C_SOURCE 200809L
#include <signal.h>
#include <unistd.h>

#include "probe.h"

static lockstep_status tick(void* leaf) {
  sigset_t all, before;
  (void)leaf;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before); /* so that none comes between the two calls */
  while (write(STDERR_FILENO, "stuck\n", 6) == 6) sigsuspend(&before);
  return LOCKSTEP_FAILURE;
}
#define LEAF_TICK tick
#include "entry.h"

#include "probe.h"
static void* create_run(const lockstep_host* host, const lockstep_caller* caller) {
  (void)host;
  (void)caller;
  return NULL;
}
#define PLUGIN_CREATE_RUN create_run
#include "entry.h"

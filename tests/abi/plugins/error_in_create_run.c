#include "probe.h"

static void* create_run(const lockstep_host* host, const lockstep_caller* caller) {
  host->set_error(caller, "no world");
  return NULL;
}
static void destroy_run(void* context) {
  (void)context;
}
#define PLUGIN_CREATE_RUN create_run
#define PLUGIN_DESTROY_RUN destroy_run
#include "entry.h"

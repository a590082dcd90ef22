/* A plugin as it was written and compiled for ABI 1.0: with the header of that version, which is
 * kept in 1.0/. It uses all that the contract had. */
#include <lockstep/leaf.h>
#include <stdlib.h>

#if LOCKSTEP_ABI_MINOR != 0
#error "this plugin is to be built with the header of ABI 1.0"
#endif

typedef struct {
  const lockstep_host* host;
  const lockstep_caller* caller;
  int64_t left;
} probe;

static void* create(const lockstep_host* host, const lockstep_caller* caller, void* run) {
  probe* it = malloc(sizeof *it);
  if (it == NULL || run == NULL) host->set_error(caller, "no memory, or no run context");
  if (it != NULL) *it = (probe){host, caller, 0};
  return it;
}
static void destroy(void* leaf) {
  free(leaf);
}
static void start(void* leaf) {
  probe* it = leaf;
  if (!it->host->get_int(it->caller, 0, &it->left)) it->host->set_error(it->caller, "no ticks");
}
static lockstep_status tick(void* leaf) {
  probe* it = leaf;
  const double period = it->host->tick_period(it->caller);
  if (it->host->set_double(it->caller, 0, period)) it->host->set_error(it->caller, "set an input");
  return --it->left > 0 ? LOCKSTEP_RUNNING : LOCKSTEP_SUCCESS;
}
static void say(void* leaf, const char* what) {
  probe* it = leaf;
  it->host->log(it->caller, LOCKSTEP_LOG_INFO, what);
}
static void halt(void* leaf) {
  say(leaf, "halt");
}
static void pause_it(void* leaf) {
  say(leaf, "pause");
}
static void resume(void* leaf) {
  say(leaf, "resume");
}
static double progress(void* leaf) {
  probe* it = leaf;
  return 1.0 / (double)(it->left + 1);
}

static int run_context;
static void* create_run(const lockstep_host* host, const lockstep_caller* caller) {
  if (host->abi_major != LOCKSTEP_ABI_MAJOR) host->set_error(caller, "another major");
  return &run_context;
}
static void destroy_run(void* context) {
  (void)context;
}

static const lockstep_port ticks = {
    sizeof(lockstep_port), LOCKSTEP_INT, LOCKSTEP_INPUT, "ticks", "3", NULL, "how many"};
static const lockstep_port* const ports[] = {&ticks};
static const lockstep_leaf_type leaf_type = {sizeof(lockstep_leaf_type),
                                             LOCKSTEP_ACTION,
                                             "Probe10",
                                             "as in 1.0",
                                             1,
                                             ports,
                                             create,
                                             destroy,
                                             start,
                                             tick,
                                             halt,
                                             pause_it,
                                             resume,
                                             progress,
                                             NULL};
static const lockstep_leaf_type* const leaf_types[] = {&leaf_type};

const lockstep_plugin lockstep_plugin_entry = {LOCKSTEP_ABI_MAJOR,
                                               LOCKSTEP_ABI_MINOR,
                                               sizeof(lockstep_plugin),
                                               "probe_1_0",
                                               "1.0",
                                               "for tests",
                                               1,
                                               leaf_types,
                                               NULL,
                                               NULL,
                                               create_run,
                                               destroy_run,
                                               NULL};

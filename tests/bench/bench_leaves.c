/* The cheapest leaves that can be: what is measured is the engine. */
#include <lockstep/leaf.h>
#include <stdlib.h>

static int g_leaf;

static void* create(const lockstep_host* host, const lockstep_caller* caller, void* run_context) {
  (void)host, (void)caller, (void)run_context;
  return &g_leaf;
}
static void destroy(void* leaf) {
  (void)leaf;
}
static lockstep_status succeed(void* leaf) {
  (void)leaf;
  return LOCKSTEP_SUCCESS;
}
static lockstep_status fail(void* leaf) {
  (void)leaf;
  return LOCKSTEP_FAILURE;
}
static lockstep_status run(void* leaf) {
  (void)leaf;
  return LOCKSTEP_RUNNING;
}
static double half(void* leaf) {
  (void)leaf;
  return 0.5;
}

/* One whose progress is another number after each tick. */
static void* create_counter(const lockstep_host* host, const lockstep_caller* caller,
                            void* run_context) {
  (void)host, (void)caller, (void)run_context;
  return calloc(1, sizeof(double));
}
static lockstep_status advance(void* leaf) {
  double* progress = leaf;
  *progress += 0.000123;
  if (*progress > 1) *progress -= 1;
  return LOCKSTEP_RUNNING;
}
static double progress(void* leaf) {
  return *(double*)leaf;
}

#define LEAF(variable, name, function)                                    \
  static const lockstep_leaf_type variable = {sizeof(lockstep_leaf_type), \
                                              LOCKSTEP_ACTION,            \
                                              name,                       \
                                              NULL,                       \
                                              0,                          \
                                              NULL,                       \
                                              create,                     \
                                              destroy,                    \
                                              NULL,                       \
                                              function,                   \
                                              NULL,                       \
                                              NULL,                       \
                                              NULL,                       \
                                              half,                       \
                                              NULL}
LEAF(kSucceed, "BenchSuccess", succeed);
LEAF(kFail, "BenchFailure", fail);
LEAF(kRun, "BenchRunning", run);
static const lockstep_leaf_type kAdvance = {sizeof(lockstep_leaf_type),
                                            LOCKSTEP_ACTION,
                                            "BenchAdvance",
                                            NULL,
                                            0,
                                            NULL,
                                            create_counter,
                                            free,
                                            NULL,
                                            advance,
                                            NULL,
                                            NULL,
                                            NULL,
                                            progress,
                                            NULL};

static const lockstep_leaf_type* const kLeaves[] = {&kSucceed, &kFail, &kRun, &kAdvance};

LOCKSTEP_EXPORT const lockstep_plugin lockstep_plugin_entry = {LOCKSTEP_ABI_MAJOR,
                                                               LOCKSTEP_ABI_MINOR,
                                                               sizeof(lockstep_plugin),
                                                               "bench_leaves",
                                                               NULL,
                                                               NULL,
                                                               4,
                                                               kLeaves,
                                                               NULL,
                                                               NULL,
                                                               NULL,
                                                               NULL,
                                                               NULL};

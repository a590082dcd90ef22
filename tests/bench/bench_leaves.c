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

#define LEAF(variable, name, function)                                                   \
  static const lockstep_leaf_type variable = {.struct_size = sizeof(lockstep_leaf_type), \
                                              .kind = LOCKSTEP_ACTION,                   \
                                              .id = name,                                \
                                              .create = create,                          \
                                              .destroy = destroy,                        \
                                              .tick = function,                          \
                                              .progress = half}
LEAF(kSucceed, "BenchSuccess", succeed);
LEAF(kFail, "BenchFailure", fail);
LEAF(kRun, "BenchRunning", run);
static const lockstep_leaf_type kAdvance = {.struct_size = sizeof(lockstep_leaf_type),
                                            .kind = LOCKSTEP_ACTION,
                                            .id = "BenchAdvance",
                                            .create = create_counter,
                                            .destroy = free,
                                            .tick = advance,
                                            .progress = progress};

/* One that reads the first `reads` of its four inputs in each tick. */
typedef struct reader {
  const lockstep_host* host;
  const lockstep_caller* caller;
  int64_t reads;
  double sum;
} reader;
enum { kReadsPort = 4 };

static void* create_reader(const lockstep_host* host, const lockstep_caller* caller,
                           void* run_context) {
  reader* self = calloc(1, sizeof(reader));
  (void)run_context;
  self->host = host;
  self->caller = caller;
  host->get_int(caller, kReadsPort, &self->reads);
  return self;
}
static lockstep_status read_ports(void* leaf) {
  reader* self = leaf;
  uint32_t port = 0;
  for (; port < self->reads; ++port) {
    double value = 0;
    self->host->get_double(self->caller, port, &value);
    self->sum += value;
  }
  return LOCKSTEP_SUCCESS;
}

#define INPUT(type, name, value) \
  { sizeof(lockstep_port), type, LOCKSTEP_INPUT, name, value, NULL, NULL, NULL, 0, 0, NULL, 0 }
static const lockstep_port kInputs[] = {
    INPUT(LOCKSTEP_DOUBLE, "a", "1"), INPUT(LOCKSTEP_DOUBLE, "b", "2"),
    INPUT(LOCKSTEP_DOUBLE, "c", "3"), INPUT(LOCKSTEP_DOUBLE, "d", "4"),
    INPUT(LOCKSTEP_INT, "reads", "0")};
static const lockstep_port* const kInputList[] = {&kInputs[0], &kInputs[1], &kInputs[2],
                                                  &kInputs[3], &kInputs[4]};
static const lockstep_leaf_type kRead = {.struct_size = sizeof(lockstep_leaf_type),
                                         .kind = LOCKSTEP_ACTION,
                                         .id = "BenchRead",
                                         .port_count = 5,
                                         .ports = kInputList,
                                         .create = create_reader,
                                         .destroy = free,
                                         .tick = read_ports};

static const lockstep_leaf_type kSees = {.struct_size = sizeof(lockstep_leaf_type),
                                         .kind = LOCKSTEP_CONDITION,
                                         .id = "BenchCondition",
                                         .create = create,
                                         .destroy = destroy,
                                         .tick = succeed};

static const lockstep_leaf_type* const kLeaves[] = {&kSucceed, &kFail, &kRun,
                                                    &kAdvance, &kRead, &kSees};

LOCKSTEP_EXPORT const lockstep_plugin lockstep_plugin_entry = {LOCKSTEP_ABI_MAJOR,
                                                               LOCKSTEP_ABI_MINOR,
                                                               sizeof(lockstep_plugin),
                                                               "bench_leaves",
                                                               NULL,
                                                               NULL,
                                                               6,
                                                               kLeaves,
                                                               NULL,
                                                               NULL,
                                                               NULL,
                                                               NULL,
                                                               NULL,
                                                               NULL};

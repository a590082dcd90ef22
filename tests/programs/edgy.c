/* Leaves that are well until a value or a moment comes that their author did not think of. */
#include <lockstep/leaf.h>
#include <stdlib.h>

static const lockstep_port parts = {.struct_size = sizeof(lockstep_port),
                                    .type = LOCKSTEP_INT,
                                    .direction = LOCKSTEP_INPUT,
                                    .name = "parts",
                                    .default_value = "4"};
static const lockstep_port* const ports[] = {&parts};

typedef struct {
  const lockstep_host* host;
  const lockstep_caller* caller;
  int is_held;
} leaf;

static void* create(const lockstep_host* host, const lockstep_caller* caller, void* context) {
  leaf* self = calloc(1, sizeof(leaf));
  (void)context;
  if (self == NULL) return NULL;
  self->host = host;
  self->caller = caller;
  return self;
}

static lockstep_status divide(void* it) {
  leaf* self = it;
  int64_t count = 1;
  if (self->host->get_int(self->caller, 0, &count) && count == 0) abort();
  return LOCKSTEP_RUNNING;
}

static lockstep_status run(void* it) {
  ((leaf*)it)->is_held = 0;
  return LOCKSTEP_RUNNING;
}

static void hold(void* it) {
  ((leaf*)it)->is_held = 1;
}

static void halt(void* it) {
  if (((leaf*)it)->is_held) exit(3);
}

static double too_much(void* it) {
  (void)it;
  return 37;
}

#define LEAF                                                                            \
  .struct_size = sizeof(lockstep_leaf_type), .kind = LOCKSTEP_ACTION, .create = create, \
  .destroy = free
static const lockstep_leaf_type divides = {
    LEAF, .id = "Divides", .doc = "x", .port_count = 1, .ports = ports, .tick = divide};
static const lockstep_leaf_type ends = {LEAF,        .id = "Ends", .doc = "x",
                                        .tick = run, .halt = halt, .pause = hold};
static const lockstep_leaf_type percent = {LEAF, .id = "Percent", .doc = "x", .tick = run,
                                           .progress = too_much};
static const lockstep_leaf_type sound = {LEAF, .id = "Sound", .doc = "x", .tick = run};
static const lockstep_leaf_type* const types[] = {&divides, &ends, &percent, &sound};

const lockstep_plugin lockstep_plugin_entry = {.abi_major = LOCKSTEP_ABI_MAJOR,
                                               .abi_minor = LOCKSTEP_ABI_MINOR,
                                               .struct_size = sizeof(lockstep_plugin),
                                               .name = "edgy",
                                               .version = "1.0",
                                               .leaf_type_count = 4,
                                               .leaf_types = types};

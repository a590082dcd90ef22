/* Advance of the plugin motion, in C: the same numbers, and so the same recording. */
#include <lockstep/leaf.h>
#include <math.h>
#include <stdlib.h>

static const lockstep_port step_port = {
    .struct_size = sizeof(lockstep_port),
    .type = LOCKSTEP_DOUBLE,
    .direction = LOCKSTEP_INPUT,
    .name = "step",
    .default_value = "0.01",
};
static const lockstep_port* const ports[] = {&step_port};

typedef struct advance {
  const lockstep_host* host;
  const lockstep_caller* caller;
  double done, step;
} advance;

static void* create(const lockstep_host* host, const lockstep_caller* caller, void* run_context) {
  advance* self = calloc(1, sizeof *self);
  (void)run_context;
  if (self == NULL) {
    host->set_error(caller, "out of memory");
    return NULL;
  }
  self->host = host;
  self->caller = caller;
  return self;
}

static void start(void* leaf) {
  advance* self = leaf;
  self->done = 0;
  self->host->get_double(self->caller, 0, &self->step);
}

static lockstep_status tick(void* leaf) {
  advance* self = leaf;
  self->done = fmin(1, self->done + self->step);
  return self->done >= 1 - 1e-9 ? LOCKSTEP_SUCCESS : LOCKSTEP_RUNNING;
}

static double progress(void* leaf) {
  return ((const advance*)leaf)->done;
}

static const lockstep_leaf_type advance_type = {
    .struct_size = sizeof(lockstep_leaf_type),
    .kind = LOCKSTEP_ACTION,
    .id = "Advance",
    .port_count = 1,
    .ports = ports,
    .create = create,
    .destroy = free,
    .start = start,
    .tick = tick,
    .progress = progress,
};
static const lockstep_leaf_type* const leaf_types[] = {&advance_type};

const lockstep_plugin lockstep_plugin_entry = {
    .abi_major = LOCKSTEP_ABI_MAJOR,
    .abi_minor = LOCKSTEP_ABI_MINOR,
    .struct_size = sizeof(lockstep_plugin),
    .name = "advance_c",
    .leaf_type_count = 1,
    .leaf_types = leaf_types,
};

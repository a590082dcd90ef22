/* A plugin of one action, in C99: it counts a number of ticks. */
#include <lockstep/leaf.h>

#include <stdlib.h>

enum { PORT_TICKS, PORT_COUNT };

static const lockstep_port ticks_port = {
    .struct_size = sizeof(lockstep_port),
    .type = LOCKSTEP_INT,
    .direction = LOCKSTEP_INPUT,
    .name = "ticks",
    .default_value = "10",
    .doc = "how many ticks it takes, at least 1",
};
static const lockstep_port* const ports[PORT_COUNT] = {&ticks_port};

typedef struct countdown {
  const lockstep_host* host;
  const lockstep_caller* caller;
  int64_t ticks;
  int64_t done;
} countdown;

static void* create(const lockstep_host* host, const lockstep_caller* caller, void* run_context) {
  countdown* self = calloc(1, sizeof *self);
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
  countdown* self = leaf;
  self->done = 0;
  if (!self->host->get_int(self->caller, PORT_TICKS, &self->ticks)) {
    self->host->set_error(self->caller, "port 'ticks' has no value");
  } else if (self->ticks < 1) {
    self->host->set_error(self->caller, "port 'ticks' is below 1");
  }
}

static lockstep_status tick(void* leaf) {
  countdown* self = leaf;
  ++self->done;
  return self->done >= self->ticks ? LOCKSTEP_SUCCESS : LOCKSTEP_RUNNING;
}

static double progress(void* leaf) {
  const countdown* self = leaf;
  return (double)self->done / (double)self->ticks;
}

static const lockstep_leaf_type countdown_type = {
    .struct_size = sizeof(lockstep_leaf_type),
    .kind = LOCKSTEP_ACTION,
    .id = "Countdown",
    .doc = "Succeeds in the last of a number of ticks",
    .port_count = PORT_COUNT,
    .ports = ports,
    .create = create,
    .destroy = free,
    .start = start,
    .tick = tick,
    .progress = progress,
};
static const lockstep_leaf_type* const leaf_types[] = {&countdown_type};

const lockstep_plugin lockstep_plugin_entry = {
    .abi_major = LOCKSTEP_ABI_MAJOR,
    .abi_minor = LOCKSTEP_ABI_MINOR,
    .struct_size = sizeof(lockstep_plugin),
    .name = "countdown",
    .version = "0.1",
    .doc = "Counts ticks: where to start your own plugin",
    .leaf_type_count = sizeof leaf_types / sizeof leaf_types[0],
    .leaf_types = leaf_types,
};

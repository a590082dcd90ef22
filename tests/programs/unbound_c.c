/* The same in C, with a port that has no value. */
#include <lockstep/leaf.h>
#include <stdlib.h>

static const lockstep_port out = {.struct_size = sizeof(lockstep_port),
                                  .type = LOCKSTEP_DOUBLE,
                                  .direction = LOCKSTEP_OUTPUT,
                                  .name = "out"};
static const lockstep_port both = {.struct_size = sizeof(lockstep_port),
                                   .type = LOCKSTEP_DOUBLE,
                                   .direction = LOCKSTEP_INOUT,
                                   .name = "both",
                                   .default_value = "0.25"};
static const lockstep_port maybe = {.struct_size = sizeof(lockstep_port),
                                    .type = LOCKSTEP_DOUBLE,
                                    .direction = LOCKSTEP_INOUT,
                                    .name = "maybe",
                                    .flags = LOCKSTEP_OPTIONAL};
static const lockstep_port* const ports[] = {&out, &both, &maybe};

typedef struct {
  const lockstep_host* host;
  const lockstep_caller* caller;
  int ticks;
} leaf;

static void* create(const lockstep_host* host, const lockstep_caller* caller, void* context) {
  leaf* self = malloc(sizeof(leaf));
  (void)context;
  if (self == NULL) return NULL;
  self->host = host;
  self->caller = caller;
  self->ticks = 0;
  return self;
}

static void say(leaf* self) {
  double value = 0;
  const char* text = "both none";
  if (self->host->get_double(self->caller, 1, &value))
    text = value == 0.25 ? "both 0.25" : "both 2";
  self->host->log(self->caller, LOCKSTEP_LOG_INFO, text);
  text = self->host->get_double(self->caller, 2, &value) ? "maybe 3" : "maybe none";
  self->host->log(self->caller, LOCKSTEP_LOG_INFO, text);
}

static lockstep_status tick(void* it) {
  leaf* self = it;
  say(self);
  if (++self->ticks == 2) return LOCKSTEP_SUCCESS;
  self->host->set_double(self->caller, 0, 1);
  self->host->set_double(self->caller, 1, 2);
  self->host->set_double(self->caller, 2, 3);
  say(self);
  return LOCKSTEP_RUNNING;
}

static const lockstep_leaf_type unbound = {.struct_size = sizeof(lockstep_leaf_type),
                                           .kind = LOCKSTEP_ACTION,
                                           .id = "Unbound",
                                           .doc = "sets what no one bound",
                                           .port_count = 3,
                                           .ports = ports,
                                           .create = create,
                                           .destroy = free,
                                           .tick = tick};
static const lockstep_leaf_type* const types[] = {&unbound};

const lockstep_plugin lockstep_plugin_entry = {.abi_major = LOCKSTEP_ABI_MAJOR,
                                               .abi_minor = LOCKSTEP_ABI_MINOR,
                                               .struct_size = sizeof(lockstep_plugin),
                                               .name = "unbound_c",
                                               .version = "1.0",
                                               .leaf_type_count = 1,
                                               .leaf_types = types};

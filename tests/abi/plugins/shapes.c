/* A leaf whose ports depend on its element: <Shape kind="round" size.radius="2" out.area="{a}"/>.
 */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "lockstep/leaf.h"

#ifndef SHAPE_DESCRIBE
#define SHAPE_DESCRIBE describe
#endif
#ifndef SHAPE_DEFAULT /* a kind */
#define SHAPE_DEFAULT NULL
#endif

typedef struct shape {
  const char* kind;
  double factor; /* of the square of its size */
  lockstep_port size;
  const lockstep_port* ports[4];
  lockstep_leaf_type type;
} shape;

typedef struct leaf {
  const lockstep_host* host;
  const lockstep_caller* caller;
  const shape* shape;
} leaf;

enum { KIND, AREA, TEXT, SIZE };

static void* create(const lockstep_host* host, const lockstep_caller* caller, void* context) {
  (void)context;
  const lockstep_place* const place = host->get_extension(LOCKSTEP_PLACE);
  leaf* const made = malloc(sizeof *made);
  if (made == NULL) return NULL;
  *made = (leaf){host, caller, place->data(caller)};
  if (made->shape == NULL) host->set_error(caller, "it has no shape");
  return made;
}

static void destroy(void* self) {
  free(self);
}

static lockstep_status tick(void* self) {
  const leaf* const it = self;
  double size = 0;
  char text[64];
  const double factor = it->shape->factor;
  if (!it->host->get_double(it->caller, SIZE, &size)) return LOCKSTEP_FAILURE;
  it->host->set_double(it->caller, AREA, factor * size * size);
  const int length = snprintf(text, sizeof text, "%s of %g", it->shape->kind, size);
  it->host->set_string(it->caller, TEXT, text, (size_t)length);
  return LOCKSTEP_SUCCESS;
}

static const lockstep_port kind_port = {.struct_size = sizeof(lockstep_port),
                                        .type = LOCKSTEP_STRING,
                                        .direction = LOCKSTEP_INPUT,
                                        .name = "kind",
                                        .doc = "which shape",
                                        .default_value = SHAPE_DEFAULT,
                                        .flags = LOCKSTEP_FIXED};
static const lockstep_port area_port = {.struct_size = sizeof(lockstep_port),
                                        .type = LOCKSTEP_DOUBLE,
                                        .direction = LOCKSTEP_OUTPUT,
                                        .name = "out.area",
                                        .doc = "its area"};
static const lockstep_port text_port = {.struct_size = sizeof(lockstep_port),
                                        .type = LOCKSTEP_STRING,
                                        .direction = LOCKSTEP_OUTPUT,
                                        .name = "out.text"};
static const lockstep_port* const base_ports[] = {&kind_port};

#define BASE(PORTS, COUNT)                                                           \
  .struct_size = sizeof(lockstep_leaf_type), .kind = LOCKSTEP_ACTION, .id = "Shape", \
  .doc = "computes an area", .ports = PORTS, .port_count = COUNT, .create = create,  \
  .destroy = destroy, .tick = tick, .flags = LOCKSTEP_AT_ONCE
#define SHAPE(KIND, FACTOR, NAME)             \
  {                                           \
    .kind = KIND, .factor = FACTOR, .size = { \
      .struct_size = sizeof(lockstep_port),   \
      .type = LOCKSTEP_NUMBER,                \
      .direction = LOCKSTEP_INPUT,            \
      .name = NAME,                           \
      .unit = "m",                            \
      .doc = "how large it is",               \
      .max = 100                              \
    }                                         \
  }

static shape shapes[] = {SHAPE("round", 3.0, "size.radius"), SHAPE("square", 1.0, "size.side")};

static const lockstep_leaf_type* describe(const lockstep_fixed* fixed, uint32_t count,
                                          lockstep_refusal* why) {
  const char* const kind = count == 1 ? fixed[0].text : "";
  for (size_t i = 0; i < sizeof shapes / sizeof *shapes; ++i) {
    shape* const it = &shapes[i];
    if (strcmp(kind, it->kind) != 0) continue;
    it->ports[KIND] = &kind_port;
    it->ports[AREA] = &area_port;
    it->ports[TEXT] = &text_port;
    it->ports[SIZE] = &it->size;
    it->type = (lockstep_leaf_type){BASE(it->ports, 4), .data = it};
    return &it->type;
  }
  if (strcmp(kind, "nameless") == 0) return NULL;
  why->port = "kind";
  why->message = "there is no such shape";
  why->hint = "use round or square";
  return NULL;
}

static const lockstep_leaf_type type = {BASE(base_ports, 1), .more_ports = "size.*;out.*",
                                        .describe = SHAPE_DESCRIBE};
static const lockstep_leaf_type* const types[] = {&type};

const lockstep_plugin lockstep_plugin_entry = {.abi_major = LOCKSTEP_ABI_MAJOR,
                                               .abi_minor = LOCKSTEP_ABI_MINOR,
                                               .struct_size = sizeof(lockstep_plugin),
                                               .name = "shapes",
                                               .doc = "for tests",
                                               .leaf_type_count = 1,
                                               .leaf_types = types};

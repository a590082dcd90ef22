/* It refuses each element, also that of its own default. */
#include "lockstep/leaf.h"

static const lockstep_leaf_type* describe_never(const lockstep_fixed* fixed, uint32_t count,
                                                lockstep_refusal* why);
#define SHAPE_DESCRIBE describe_never
#define SHAPE_DEFAULT "round"
#include "shapes.c"

static const lockstep_leaf_type* describe_never(const lockstep_fixed* fixed, uint32_t count,
                                                lockstep_refusal* why) {
  describe(fixed, count, why);
  why->message = "there are no shapes today";
  return NULL;
}

/* What it describes for an element is another type, which cannot be made. */
#include "lockstep/leaf.h"

static const lockstep_leaf_type* describe_another(const lockstep_fixed* fixed, uint32_t count,
                                                  lockstep_refusal* why);
#define SHAPE_DESCRIBE describe_another
#include "shapes.c"

static const lockstep_leaf_type* describe_another(const lockstep_fixed* fixed, uint32_t count,
                                                  lockstep_refusal* why) {
  static const lockstep_leaf_type another = {.struct_size = sizeof another, .id = "Another"};
  describe(fixed, count, why);
  return &another;
}

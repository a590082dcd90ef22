/* An element has other ports when it is described once more. */
#include "lockstep/leaf.h"

static const lockstep_leaf_type* describe_otherwise(const lockstep_fixed* fixed, uint32_t count,
                                                    lockstep_refusal* why);
#define SHAPE_DESCRIBE describe_otherwise
#define SHAPE_DEFAULT "round"
#include "shapes.c"

static const lockstep_leaf_type* describe_otherwise(const lockstep_fixed* fixed, uint32_t count,
                                                    lockstep_refusal* why) {
  static int calls = 0;
  lockstep_fixed other = fixed[0];
  other.text = "square";
  return ++calls % 2 == 1 ? describe(fixed, count, why) : describe(&other, 1, why);
}

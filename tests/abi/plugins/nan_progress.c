#include "probe.h"

static double progress(void* leaf) {
  (void)leaf;
  return strtod("nan", NULL);
}
#define LEAF_PROGRESS progress
#include "entry.h"

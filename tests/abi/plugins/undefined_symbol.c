#include "probe.h"
void a_function_that_nobody_has(void);
static void start(void* leaf) {
  (void)leaf;
  a_function_that_nobody_has();
}
#define LEAF_START start
#include "entry.h"

#include "probe.h"

#include <stdexcept>

static lockstep_status tick(void*) {
  throw std::runtime_error("out of reach");
}
#define LEAF_TICK tick
#include "entry.h"

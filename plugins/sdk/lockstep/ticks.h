/* lockstep/ticks.h: where lockstep/ext/ticks.h was. */
#include "ext/ticks.h"

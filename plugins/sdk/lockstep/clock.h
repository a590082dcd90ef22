/* lockstep/clock.h: where lockstep/ext/clock.h was. */
#include "ext/clock.h"

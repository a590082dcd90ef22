/* lockstep/changes.h: where lockstep/ext/changes.h was. */
#include "ext/changes.h"

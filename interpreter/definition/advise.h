// Warnings and notes about a definition that is legal but probably not what was meant.
#pragma once

#include "definition/definition.h"
#include "document/reporter.h"

namespace lockstep {

void advise(const Definition& definition, const Reporter& report);

}  // namespace lockstep

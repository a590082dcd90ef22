// Warnings and notes about a definition that is valid but probably not intended.
#pragma once

#include "definition/definition.h"
#include "document/reporter.h"

namespace lockstep::host {

void advise(const Definition& definition, const Reporter& report);

}  // namespace lockstep::host

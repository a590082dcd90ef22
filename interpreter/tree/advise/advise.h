// Warnings and notes about a definition that is valid but probably not intended.
#pragma once

#include "language/document/reporter.h"
#include "tree/definition.h"

namespace lockstep::host {

void advise(const Definition& definition, const Reporter& report);

// Asks what robots do while their leaves are held, and names those that go on.
void advise_holds(const Definition& definition, const Reporter& report);

// Asks whether what a node paces can be slowed, and what does not go slower with it.
void advise_paces(const Definition& definition, const Reporter& report);

}  // namespace lockstep::host

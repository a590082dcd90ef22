// The last part of what `lockstep check` says of a tree, for all who say the same.
#pragma once

#include <functional>

#include "base/core/diagnostics.h"
#include "language/document/project.h"
#include "tree/definition.h"
#include "verify/advice.h"

namespace lockstep::host {

// Adds what a short search over the behaviors of the tree finds. Plugins are not called. Other
// arguments make another tree, so nothing is certain of a project with arguments.
// Adds nothing once `stop_signal` returns something else than 0.
void add_advice(const Project& project, Definition definition, AdviceEffort effort,
                Diagnostics& diagnostics, std::function<int()> stop_signal = {});

// The same with little effort, before a run. It takes no time for a tree in which nothing is held.
void add_advice_of_run(const Project& project, const Definition& definition,
                       Diagnostics& diagnostics);

}  // namespace lockstep::host

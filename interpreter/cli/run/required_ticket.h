// `run --require-ticket`: a tree that is not the one that `lockstep verify` has proved does not
// run.
#pragma once

#include "cli/run/run_options.h"
#include "run/loading/load.h"

namespace lockstep::host {

// Prints what was not proved. The rate becomes that of the proof where none is given. Returns
// kExitSuccess if the tree may run, else the exit code of what is printed.
int require_ticket(RunCommandOptions& options, const Loaded& loaded);

}  // namespace lockstep::host

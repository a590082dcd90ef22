// --leaves: what the leaves do is read from a file, and no plugin is asked.
#pragma once

#include "cli/run/run_options.h"
#include "leaves/play/played_leaves.h"

namespace lockstep::host {

// Reads it, and what it says of the run where the command line says nothing. False, with a message,
// if it cannot be used.
bool read_scripts(RunCommandOptions& options, LeafScripts& scripts);
// Gives the leaves of a tree their scripts. False, with a message, if these are of another tree.
bool give_scripts(const RunCommandOptions& options, LeafScripts scripts, const Tree& tree,
                  PlayedLeaves& played);

}  // namespace lockstep::host

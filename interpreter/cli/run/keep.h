// --checkpoint and --resume: a refusal as messages and exit codes.
#pragma once

#include <memory>
#include <tl/expected.hpp>

#include "cli/run/run_options.h"
#include "run/kept_run.h"
#include "run/loading/tree_identity.h"

namespace lockstep::host {

// What makes a run: the tree, and the options that change its ticks.
TreeIdentity identity_of_run(const RunCommandOptions& options, const Loaded& loaded);

// Null: it is not kept. An exit code: it is refused, which is reported.
tl::expected<std::unique_ptr<KeptRun>, int> keep(const RunCommandOptions& options,
                                                 TreeIdentity identity, const Tree& tree);

}  // namespace lockstep::host

// The leaves of a program in one run, and the processes that do them.
#pragma once

#include <memory>

#include "leaves/remote/json_lines/program_plugin.h"

namespace lockstep::host {

std::unique_ptr<RemoteRun> begin_program_run(ProgramPlugin& plugin, const lockstep_caller& caller);

}  // namespace lockstep::host

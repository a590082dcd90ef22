// The values that an option could have, by the name of its type in --help.
#pragma once

#include <string>

#include "cli/command_walk.h"
#include "cli/tools/completion/candidates.h"

namespace lockstep::host {

// The values that fit an option of the command that the line names.
Candidates values_of(const CLI::Option& option, const CommandWalk& walk);

std::string first_sentence(const std::string& text);

}  // namespace lockstep::host

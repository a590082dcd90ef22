// The messages of `lockstep check` for other programs: scripts, GitHub.
#pragma once

#include <span>
#include <string>

#include "cli/check_mends.h"

namespace lockstep::host {

// An array of objects.
std::string as_json(std::span<const MendableMessage> messages);

// Workflow commands of GitHub Actions, a line each, which become annotations of the files.
std::string as_github(std::span<const MendableMessage> messages);

}  // namespace lockstep::host

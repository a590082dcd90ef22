// The messages of `lockstep check` for other programs: editors, scripts, GitHub.
#pragma once

#include <span>
#include <string>

#include "base/core/diagnostics.h"

namespace lockstep::host {

// An array of objects.
std::string as_json(std::span<const Diagnostic> messages);

// Workflow commands of GitHub Actions, a line each, which become annotations of the files.
std::string as_github(std::span<const Diagnostic> messages);

// A log in SARIF 2.1.0 (OASIS), as code scanners write it.
std::string as_sarif(std::span<const Diagnostic> messages);

}  // namespace lockstep::host

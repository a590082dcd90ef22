// Messages of the check as the protocol has them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "author/server/workspace.h"
#include "base/json/json.h"

namespace lockstep::host {

// Those of one analysis, by the URI of the file that each is about.
using DiagnosticsByUri = std::map<std::string, std::vector<Json>>;
DiagnosticsByUri diagnostics_of(const Analysis& analysis, const Workspace& workspace,
                                bool has_related_information);

}  // namespace lockstep::host

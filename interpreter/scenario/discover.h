// Finds scenarios as pytest finds tests: by the names of files.
#pragma once

#include <string>
#include <vector>

#include "base/core/problem.h"

namespace lockstep::host {

// Files as they are named; of folders all NAME.test.xml in them and below, and all other .xml with
// a <scenario>. Sorted within a folder; each once. Names that begin with a dot are left out.
Result<std::vector<std::string>> find_scenario_files(const std::vector<std::string>& paths);

}  // namespace lockstep::host

// Reads scenarios: NAME.test.xml, or those that are in a tree file of our own language.
#pragma once

#include <memory>
#include <string>

#include "base/core/diagnostics.h"
#include "scenario/scenario.h"

namespace lockstep::host {

// Reports all errors; null if there is no text to read, or it is of something else. A tree file
// without scenarios has none.
std::unique_ptr<ScenarioFile> read_scenarios(const std::string& path, Diagnostics& diagnostics);
std::unique_ptr<ScenarioFile> read_scenarios(const std::string& path, std::string text,
                                             Diagnostics& diagnostics);

}  // namespace lockstep::host

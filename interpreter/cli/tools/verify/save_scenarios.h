// `verify --save`: counter-examples as scenarios, which `lockstep test` plays again.
#pragma once

#include <string>

#include "cli/tools/verify/verify_report.h"
#include "engine/tree.h"
#include "language/property/property.h"

namespace lockstep::host {

// Adds a scenario for each finding that has a recording. False, with a message, if it cannot.
bool save_scenarios(const std::string& path, const VerifyReport& report, const Tree& tree,
                    const std::vector<Property>& properties);

}  // namespace lockstep::host

// The XML schema of files of scenarios, from the table that their reader uses.
#pragma once

#include <string>

namespace lockstep::host {

std::string make_scenario_xsd();

}  // namespace lockstep::host

// What `lockstep --version --verbose` says, for reports of bugs.
#pragma once

#include <string>

namespace lockstep::host {

std::string about_text();

}  // namespace lockstep::host

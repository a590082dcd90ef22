// The text of `lockstep --version --verbose`, for reports of bugs.
#pragma once

#include <string>

namespace lockstep::host {

std::string about_text();

}  // namespace lockstep::host

// An edit as a unified diff, which patch and git apply read.
#pragma once

#include <string>
#include <string_view>

#include "language/document/text_edit.h"

namespace lockstep::host {

// "" if the edit changes nothing. Three lines of context.
std::string unified_diff(std::string_view path, std::string_view text, const TextEdit& edit);

}  // namespace lockstep::host

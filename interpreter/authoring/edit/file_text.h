// A file whose text is edited: it keeps its byte order mark, its mode and its name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/problem.h"

namespace lockstep::host {

// The byte order mark, which a document leaves out, or "".
std::string_view byte_order_mark(std::string_view text);

// Replaces the file in one step: it has the old text or the new one, whatever happens. A link
// stays, and the file that it leads to is replaced.
std::optional<Problem> replace_file(const std::string& path, std::string_view text);

}  // namespace lockstep::host

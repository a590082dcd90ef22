// Compression that browsers undo.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

// The same bytes give the same result.
std::string gzip(std::string_view bytes);

}  // namespace lockstep::host

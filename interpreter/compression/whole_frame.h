// A text as one zstd frame that says how long the text is.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

// Throws a std::runtime_error if there is no libzstd.
std::string zstd_frame(std::string_view text);

}  // namespace lockstep::host

#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

// `text` in quotes if it holds a comma, a quote or a line break (RFC 4180).
std::string csv_field(std::string_view text);

}  // namespace lockstep::host

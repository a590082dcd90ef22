// Values of attributes as scripts of both languages write them.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

// A number, true, false, or a text in quotation marks; "" if a script cannot write it.
std::string literal_of(std::string_view value);
// A text in any case.
std::string quoted_literal(std::string_view value);

}  // namespace lockstep::host

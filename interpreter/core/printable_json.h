// printable() for JSON that is printed: what a terminal would obey is written as the escapes that
// JSON has for it, so the values stay what they are. Not for files.
#pragma once

#include <string>
#include <string_view>

namespace lockstep {

// `json` is whole JSON in UTF-8, as a serializer makes it.
std::string printable_json(std::string_view json);

}  // namespace lockstep

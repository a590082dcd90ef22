// A path, which may hold any byte, as it stands in a URI: RFC 3986.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

std::string path_in_uri(std::string_view path);

}  // namespace lockstep::host

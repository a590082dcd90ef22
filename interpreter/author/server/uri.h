// Names of files in the protocol: file:///home/me/my%20tree.xml.
#pragma once

#include <string>
#include <string_view>

namespace lockstep::host {

// A URI of no file, such as untitled:Untitled-1, stays as it is.
std::string path_of_uri(std::string_view uri);
std::string uri_of_path(std::string_view path);

}  // namespace lockstep::host

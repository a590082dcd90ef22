// Names that a port cannot have in a source, since its language or what a leaf derives from has
// them.
#pragma once

#include <string_view>

namespace lockstep::host {

// As a member of the ports of a leaf in C++.
bool is_taken_in_cpp(std::string_view name);
// As an attribute of a leaf in Python.
bool is_taken_in_python(std::string_view name);

}  // namespace lockstep::host

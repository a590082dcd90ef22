// Defaults of ports, as the languages of plugins write them.
#pragma once

#include <string>
#include <string_view>

#include "author/scaffold/languages.h"

namespace lockstep::host {

// The text between the quotes of a literal.
std::string in_quotes(std::string_view text);
// A value of this type, in Python or C++: `text` is one, as a tree would write it.
std::string literal(const SourceLanguage& language, const PortType& type, std::string_view text);

}  // namespace lockstep::host

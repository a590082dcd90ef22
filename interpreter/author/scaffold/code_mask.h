// The code of a source, without what only looks like code.
#pragma once

#include <string>
#include <string_view>

#include "author/scaffold/languages.h"

namespace lockstep::host {

// The text with blanks in place of comments and of what is in quotes: each place of the one is that
// place of the other. Line breaks stay.
std::string code_mask(const SourceLanguage& language, std::string_view text);

// The place of the bracket that closes the one at `open`; npos if there is none.
std::size_t closing_bracket(std::string_view mask, std::size_t open);

}  // namespace lockstep::host

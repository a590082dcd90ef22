// What XML takes of a text that the lenient grammar of BehaviorTree.CPP takes too.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "language/document/scanner.h"

namespace lockstep::host {

// Whether an instruction or a DOCTYPE of `text` is one of XML, too.
bool is_strict_xml(std::string_view text, const XmlToken& token);

// The end of what one text token has of `text`: a CDATA section whole, or up to the blanks behind
// it.
std::size_t end_of_text(std::string_view text, const XmlToken& token);

// What is in a comment as XML takes it, without "--". Nothing: XML takes it as it is.
std::optional<std::string> comment_in_xml(std::string_view inside);

}  // namespace lockstep::host

// Lines of a text that may be indented differently: those that do not begin within a value. `xml`
// is elements and comments; lines that begin within a comment count, the first one and blank ones
// do not.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "language/document/scanner.h"
#include "language/document/text_edit.h"

namespace lockstep::host {

// Replaces `from` at the begin of these lines by `to`; a line that does not begin so stays. `xml`
// is at byte `at` of the text that is edited.
void shift_lines(TextEdit& edit, std::size_t at, std::string_view xml, Grammar grammar,
                 std::string_view from, std::string_view to);

// `xml` with these lines shifted, and with these line ends before them.
std::string shifted(std::string_view xml, Grammar grammar, std::string_view from,
                    std::string_view to);
std::string with_line_ends(std::string_view xml, Grammar grammar, std::string_view line_end);

}  // namespace lockstep::host

// The grammar of <?…?> and <!DOCTYPE …>. Nothing in them counts, but a file is XML only when they
// are right, and other programs refuse it when they are not.
#pragma once

#include <optional>

#include "document/cursor.h"

namespace lockstep {

// Moves `at`, which is at "<?", behind the processing instruction or the XML declaration. Returns
// what is wrong with it.
std::optional<XmlFault> skip_instruction(Cursor& at);

// The same for "<!DOCTYPE". One that defines something is refused.
std::optional<XmlFault> skip_doctype(Cursor& at);

}  // namespace lockstep

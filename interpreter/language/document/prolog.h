// The grammar of <?…?> and <!DOCTYPE …>. Their content has no meaning here, but a file with errors
// in them is not XML, and other programs refuse it.
#pragma once

#include <optional>

#include "language/document/cursor.h"

namespace lockstep::host {

// Moves `at`, which is at "<?", behind the processing instruction or the XML declaration. Returns
// the error in it, if any.
std::optional<XmlFault> skip_instruction(Cursor& at);

// The same for "<!DOCTYPE". A DOCTYPE with definitions is refused.
std::optional<XmlFault> skip_doctype(Cursor& at);

}  // namespace lockstep::host

// Messages of the check as the protocol has them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "author/server/workspace.h"
#include "base/json/json.h"
#include "language/document/lines.h"

namespace lockstep::host {

// Which bytes of `text` a message at this place is about: a tag, a name, a value.
ByteRange range_of(std::string_view text, const LineIndex& lines, const SourceLocation& place);

// Those of one analysis, by the URI of the file that each is about.
using DiagnosticsByUri = std::map<std::string, std::vector<Json>>;
DiagnosticsByUri diagnostics_of(const Analysis& analysis, const Workspace& workspace,
                                bool has_related_information);

}  // namespace lockstep::host

// Changes of texts as the protocol has them.
#pragma once

#include <map>
#include <string>

#include "authoring/edit/text_edit.h"
#include "authoring/server/positions.h"
#include "json/json.h"

namespace lockstep::host {

Json json_of(const TextEdit& edit, const Positions& positions);

// The changes of several files, by their URIs.
Json workspace_edit(const std::map<std::string, Json>& edits);

}  // namespace lockstep::host

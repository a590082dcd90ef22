// Which attributes of a node are scripts, and which name an entry without braces.
#pragma once

#include <string_view>

#include "base/core/language.h"
#include "language/document/document.h"
#include "tree/catalog.h"

namespace lockstep::host {

// The built-in node of that element; null if it is another one, or none.
const NodeType* type_at(const Document& document, std::uint32_t element, const Catalog& nodes);

bool is_script_at(std::string_view attribute, const NodeType* type, const LanguageRules& rules);
bool is_entry_at(std::string_view attribute, const NodeType* type);

}  // namespace lockstep::host

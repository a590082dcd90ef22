// A tree file for version 3 of BehaviorTree.CPP in the words of version 4.
#pragma once

#include <string>

#include "language/document/document.h"
#include "language/document/reporter.h"
#include "tree/catalog.h"

namespace lockstep::host {

// Whether it is for BehaviorTree.CPP, and for version 3 or older.
bool is_older_form(const Document& document);

// The value of an attribute of a node with that tag: in a SubTree a text named an entry, and
// "${key}" named one before version 3. `has_arguments`: lockstep reads <arg> in both languages, so
// "${key}" may be one. Warns where a text becomes an entry.
std::string value_since_4(std::string_view tag, const Attribute& attribute, bool has_arguments,
                          const Reporter& report);

// `nodes`: the built-in ones of version 4. Nothing, with errors, if something in it is gone.
std::optional<std::string> convert_since_4(const Document& document, const Catalog& nodes,
                                           const Reporter& report);

}  // namespace lockstep::host

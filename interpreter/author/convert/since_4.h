// A tree file for version 3 of BehaviorTree.CPP in the words of version 4.
#pragma once

#include <string>

#include "language/document/document.h"
#include "language/document/reporter.h"
#include "tree/catalog.h"

namespace lockstep::host {

// Whether it is for BehaviorTree.CPP, and for version 3 or older.
bool is_older_form(const Document& document);

// `nodes`: the built-in ones of version 4. Nothing, with errors, if something in it is gone.
std::optional<std::string> convert_since_4(const Document& document, const Catalog& nodes,
                                           const Reporter& report);

}  // namespace lockstep::host

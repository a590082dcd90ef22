// A tree file in the other language: the same trees, with its comments, blanks and order.
#pragma once

#include <optional>
#include <string>

#include "base/core/language.h"
#include "language/document/document.h"
#include "language/document/reporter.h"
#include "tree/catalog.h"
#include "tree/check/models.h"
#include "tree/definition.h"

namespace lockstep::host {

struct Conversion {
  const LanguageRules& from;
  const LanguageRules& to;
  const Catalog& from_nodes;  // the built-in nodes of the language of the document
  const Catalog& to_nodes;    // and of the other one
  const Models& models;       // of the document, and of the files that it includes
  const Definition* meaning;  // of its main tree; null: it has errors, or none
  const Project* project;     // the document and the files that it includes; null: not known
};

// Nothing, with errors, if something in it cannot be said in the other language. Marks of editors
// are left out, with a note; a TreeNodesModel stays. Nodes that are not built in are copied as they
// are.
std::optional<std::string> convert(const Document& document, const Conversion& conversion,
                                   const Reporter& report);

}  // namespace lockstep::host

#include "support/tree_document.h"

#include "base/core/diagnostics.h"
#include "engine/compile.h"
#include "language/document/project.h"
#include "run/loading/plugins.h"
#include "support/scripted_types.h"
#include "tree/resolve.h"

namespace lockstep::host::test {
namespace {

Catalog scripted_catalog() {
  Catalog catalog = make_catalog({});
  for (const NodeType* leaf : {&kScriptedActionType, &kScriptedConditionType, &kBareActionType}) {
    catalog.add(leaf);
  }
  return catalog;
}

std::string errors_in(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& it : diagnostics.all()) {
    if (it.severity == Severity::Error) text += it.message + '\n';
  }
  return text;
}

}  // namespace

LoadedDocument tree_from_document(const std::string& xml) {
  static const Catalog catalog = scripted_catalog();
  Diagnostics diagnostics;
  const auto project = load_project_text("test.xml", xml, {}, diagnostics);
  if (project == nullptr) return {std::nullopt, errors_in(diagnostics)};
  const auto definition = resolve(*project, catalog, {}, diagnostics);
  if (!definition) return {std::nullopt, errors_in(diagnostics)};
  return {compile(*definition), ""};
}

}  // namespace lockstep::host::test

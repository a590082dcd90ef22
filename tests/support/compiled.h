// A compiled tree from a whole document, with the nodes of plugins.
#pragma once

#include <stdexcept>
#include <string>

#include "base/core/diagnostics.h"
#include "engine/compile.h"
#include "language/document/project.h"
#include "run/loading/plugins.h"
#include "tree/resolve.h"

namespace lockstep::host::test {

// Throws what is wrong with the document.
inline Tree compiled(const std::string& text, const PluginSet& plugins = {}) {
  Diagnostics diagnostics;
  const auto project = load_project_text("tree.xml", text, {}, diagnostics);
  if (project != nullptr) {
    const auto definition = resolve(*project, make_catalog(plugins), {}, diagnostics);
    if (definition) return compile(*definition);
  }
  throw std::invalid_argument(diagnostics.all().front().message);
}

}  // namespace lockstep::host::test

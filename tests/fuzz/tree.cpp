// Any text as a tree file: ends in errors with a place, or in a tree that ticks a hundred times.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "definition/plugin_requests.h"
#include "definition/resolve.h"
#include "engine/compile.h"
#include "runtime/run.h"

namespace {

using namespace lockstep;

void tick(const Tree& tree) {
  Run run(tree, {});
  for (int i = 0; i < 100; ++i) {
    const Status status = run.tick(i * run.period());
    if (status == Status::Idle || run.fault() != nullptr) std::abort();  // no leaf here may fail
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Catalog catalog;
  for (const NodeKind* kind : built_in_kinds()) catalog.add(&kind->type);
  Diagnostics diagnostics;
  const auto project = load_project_text(
      "/nowhere/tree.xml", std::string(reinterpret_cast<const char*>(data), size), {}, diagnostics);
  if (project == nullptr) {
    if (!diagnostics.has_errors()) std::abort();
    return 0;
  }
  requested_plugins(*project, diagnostics);
  const auto definition = resolve(*project, catalog, {}, diagnostics);
  if (definition.has_value() == diagnostics.has_errors()) std::abort();
  diagnostics.sort();
  for (const Diagnostic& diagnostic : diagnostics.all()) {
    if (render(diagnostic, false).empty()) std::abort();
  }
  if (definition && definition->nodes.size() < 10'000) tick(compile(*definition));
  return 0;
}

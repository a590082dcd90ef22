// A tree of one control node and many leaves of the bench plugin. Used by the benchmarks.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "definition/resolve.h"
#include "engine/compile.h"
#include "plugin/plugin_set.h"

namespace lockstep {

// `opening` with `leaves` leaves inside, compiled.
class BenchTree {
 public:
  BenchTree(const std::string& control, const std::string& attributes, const std::string& leaf,
            std::int64_t leaves) {
    std::string text =
        fmt::format("<root lockstep=\"1\"><BehaviorTree ID=\"B\"><{} {}>", control, attributes);
    for (std::int64_t i = 0; i < leaves; ++i) text += fmt::format("<{}/>", leaf);
    text += fmt::format("</{}></BehaviorTree></root>", control);
    Diagnostics diagnostics;
    plugins_.load_file(LOCKSTEP_BENCH_LEAVES, diagnostics);
    const auto project = load_project_text("bench.xml", text, {}, diagnostics);
    Catalog catalog;
    for (const NodeKind* kind : built_in_kinds()) catalog.add(&kind->type);
    for (const NodeType* type : plugins_.types()) catalog.add(type);
    const auto definition = resolve(*project, catalog, {}, diagnostics);
    if (!definition) std::abort();
    tree_ = compile(*definition);
  }
  const Tree& tree() const { return tree_; }

 private:
  PluginSet plugins_;
  Tree tree_;
};

}  // namespace lockstep

// Asks a leaf of a shared object for everything that runs ask for, in this process: a leaf that
// crashes or hangs ends it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/core/node_type.h"
#include "run/loading/plugin_set.h"

namespace lockstep::host {

struct LeafReport {
  // A finding: whether the leaf keeps to lockstep/leaf.h, and in words.
  std::function<void(bool is_good, const std::string& text)> note;
  // Names the next step before it begins, since the leaf may not return from it: "with level=-1".
  std::function<void(const std::string& what)> about_to;
};

void examine_leaf(const NodeType& type, const std::shared_ptr<PluginSet>& plugins,
                  const LeafReport& report);

}  // namespace lockstep::host

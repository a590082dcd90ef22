// What a leaf of a shared object does when a run asks of it all that runs ask. It is in this
// process: a leaf that crashes or hangs ends it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/node_type.h"
#include "loading/plugin_set.h"

namespace lockstep::host {

struct LeafReport {
  // What was found: whether it is as lockstep/leaf.h says, and in words.
  std::function<void(bool is_good, const std::string& text)> note;
  // What comes next, of which the leaf may not come back: "with level=-1".
  std::function<void(const std::string& what)> about_to;
};

void examine_leaf(const NodeType& type, const std::shared_ptr<PluginSet>& plugins,
                  const LeafReport& report);

}  // namespace lockstep::host

// A run that goes on in a new process after a cut: what its leaves keep, and what they do then.
// docs/resume.md has the rules.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/after_cut.h"
#include "engine/pace.h"
#include "trace/node_state.h"

struct lockstep_cut;

namespace lockstep::host {

struct CutLeaf {
  std::uint32_t place;  // in Tree::leaves
  AfterCut does = AfterCut::StartsAgain;
  bool is_asked = false;  // and that was its answer
  double progress = 0;    // of one that continues
};

// The bytes that leaves keep of themselves, beside a SavedRun: of each of Tree::leaves. Empty: none
// of them keeps any.
using LeafBytes = std::vector<std::string>;

// What an action with commit="true" keeps.
struct CommitState {
  LeafPace pace;
  std::uint32_t succeeded_at;   // in this tick
  std::uint32_t has_succeeded;  // its activation has ended, and it runs until a checkpoint has that
};

class NodeContext;

// In nodes/leaf.cpp, where leaves are called. Both may end in a fault of the leaf.
void save_leaf(NodeContext& context, NodeIndex node, std::span<char> room, std::string& into);
AfterCut ask_leaf_after_cut(NodeContext& context, NodeIndex node, std::string_view bytes,
                            const lockstep_cut& cut);

}  // namespace lockstep::host

// A run that goes on in a new process after a cut: what its leaves keep, and what they do then.
// docs/resume.md has the rules.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lockstep/leaf.h"
#include "trace/node_state.h"

namespace lockstep::host {

// What a leaf does that ran at the cut. The results are those of its next tick, without a call.
enum class AfterCut : std::uint8_t { BeginsAgain, GoesOn, Failure, Success };

struct CutLeaf {
  std::uint32_t place;  // in Tree::leaves
  AfterCut does = AfterCut::BeginsAgain;
  bool is_asked = false;  // and that was its answer
};

// The bytes that leaves keep of themselves, beside a SavedRun: of each of Tree::leaves. Empty: none
// of them keeps any.
using LeafBytes = std::vector<std::string>;

class NodeContext;

// In nodes/leaf.cpp, where leaves are called. Both may end in a fault of the leaf.
void save_leaf(NodeContext& context, NodeIndex node, std::span<char> room, std::string& into);
AfterCut ask_leaf_after_cut(NodeContext& context, NodeIndex node, std::string_view bytes,
                            const lockstep_cut& cut);

}  // namespace lockstep::host

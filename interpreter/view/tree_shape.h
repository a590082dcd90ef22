// The parts of a tree that a view draws, without the state of its nodes. Plain data, made from a
// running tree or from the header of a recording, so that a run and its replay look the same.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/node_type.h"
#include "engine/node_kind.h"
#include "engine/tree.h"
#include "live/header_and_end.h"

namespace lockstep::host {

struct ShapeNode {
  std::string segment, kind;        // the last of its path; its tag
  std::optional<NodeIndex> parent;  // none: the root
  std::size_t depth = 0;
  std::vector<NodeIndex> children = {};
  Synchronization synchronization = Synchronization::None;
  std::vector<std::string> resources = {};  // of a pool
  std::vector<double> barriers = {};        // Absolute; empty where an entry gives them
  std::vector<NodeIndex> in_step = {};      // synchronized: the nodes that it holds
  std::vector<std::string> names = {};      // of a group: what it calls them
  bool ignores_idle = false;                // of those, the ones that are idle
  std::optional<NodeIndex> keeper = {};     // the synchronized node that holds this one
};

struct TreeShape {
  std::string id;
  std::vector<ShapeNode> nodes = {};      // by index: pre-order
  std::vector<std::string> entries = {};  // the keys of those that a snapshot has
};

TreeShape shape_of(const Tree& tree);
TreeShape shape_of(const RecordingHeader& header);

}  // namespace lockstep::host

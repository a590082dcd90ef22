// The leaves of a run that other processes do. Nobody calls a leaf that is held, so before each
// tick the run looks whether its process is still there: the others are not to move on beside a
// driver that is dead.
#pragma once

#include <string>
#include <vector>

#include "engine/node_context.h"

namespace lockstep::host {

class ProcessLeaf {
 public:
  virtual ~ProcessLeaf() = default;
  // The trouble of the process since the last call; "" if there was none. Returns at once.
  virtual std::string trouble() = 0;
};

class ProcessLeaves {
 public:
  bool empty() const { return all_.empty(); }
  void add(NodeIndex node, ProcessLeaf& leaf) { all_.push_back({node, &leaf}); }
  void remove(const ProcessLeaf& leaf);
  // A fault for each that is held and has trouble.
  void look(NodeContext& context);

 private:
  struct Entry {
    NodeIndex node;
    ProcessLeaf* leaf;
  };
  std::vector<Entry> all_;
};

}  // namespace lockstep::host

// What the nodes of a recording had done that are idle after a tick that reached them: an ancestor
// has ended them in the same tick, so the recording has no result of them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/tree.h"
#include "record/recording.h"

namespace lockstep::host {

class EndedResults {
 public:
  // Nodes that the tree has not at the same path may do anything.
  EndedResults(const RecordingHeader& header, const Tree& tree);

  // Its status when it had been ticked. For a node that is idle it follows from what its ancestors
  // and siblings did: a node is halted only while it runs, and forgotten only if it was skipped.
  // Where several would lead to the same, the one that says least: Running, or for what is never
  // running a result with which its parent went on.
  Status of(const RecordedTick& tick, NodeIndex node) const;

 private:
  enum class Rule : std::uint8_t { AllOf, OneOf, Choice, Opposite, Retries, Other };
  static Rule rule_of(const NodeType* type);
  Status result_in(NodeIndex parent, NodeIndex node) const;
  Status below(const RecordedTick& tick, NodeIndex parent, NodeIndex node) const;
  bool is_last_ticked(const RecordedTick& tick, NodeIndex parent, NodeIndex node) const;

  std::vector<std::optional<NodeIndex>> parents_;
  std::vector<Rule> rules_;
  std::vector<bool> never_runs_;
  std::vector<std::vector<NodeIndex>> children_;
};

}  // namespace lockstep::host

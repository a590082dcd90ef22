// The state of a run as bytes that can be compared: what is active of a folded run, what its leaves
// keep, the facts, what properties remember, and the entries that the tree reads.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/saved_run.h"
#include "engine/ticker.h"
#include "leaves/model_leaf.h"

namespace lockstep::host {

using StateBytes = std::vector<std::byte>;

class StateCode {
 public:
  // `fresh` is a run before its first tick. All must outlive this.
  // `watched`: the nodes whose statuses count even where the tree does not look at them.
  StateCode(const Tree& tree, const LeafModels& models, const SavedRun& fresh,
            std::vector<bool> watched);

  // What a fold would forget of those.
  void before_fold(const Ticker& ticker);

  // Of a run that is folded.
  void encode(const Ticker& ticker, ModelLeaves& leaves, std::span<const std::byte> properties,
              StateBytes& into);
  void decode(std::span<const std::byte> from, SavedRun& run, std::vector<LeafState>& leaves,
              std::vector<FactState>& facts, std::span<std::byte> properties) const;

 private:
  void find_held(const Ticker& ticker);

  const Tree& tree_;
  const LeafModels& models_;
  const SavedRun& fresh_;
  std::vector<std::uint32_t> entries_;  // the slots that are in the state
  std::vector<bool> keeps_pause_;       // of each node: it is not the same held or not
  std::vector<NodeIndex> watched_;
  std::vector<Activity> seen_;      // of those, before the fold
  std::vector<Activity> activity_;  // of each node, as it is encoded
};

}  // namespace lockstep::host

// The points of a tick at which a leaf chooses. Two ticks from one state may come to points that
// are equal in all that what follows depends on: then the same follows, and a search follows one of
// them only. Example: a Sequence of Fallbacks of a condition and AlwaysSuccess. Behind each of them
// nothing depends on what its condition was. Another one: a Parallel in which a child has failed.
// It ends in this tick and halts its children, so nothing depends on how far those before are.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "engine/ticker.h"
#include "leaves/model_leaf.h"
#include "verify/state_code.h"
#include "verify/state_store.h"
#include "verify/tick_answers.h"

namespace lockstep::host {

// Nothing is beside the tree: that would look at nodes in a way of its own.
bool is_plain(const Tree& tree);

class TickPoints {
 public:
  // `watched`: of each node, whether a property looks at it. Points are looked at from so many
  // ticks on that begin in one state: most states have fewer.
  TickPoints(const Tree& tree, const LeafModels& models, const std::vector<bool>& watched,
             std::uint64_t few_ticks);

  // Ticks of another state follow, in which these nodes and leaves ran.
  void begin_state(const std::vector<Activity>& nodes, const std::vector<LeafState>& leaves);
  void begin_tick() {
    // Where points are all different, to look at them is in vain.
    const bool is_vain = known_.size() > kMostInVain && hits_ * kMostForHit < known_.size();
    looks_ = can_look_ && ++ticks_ > few_ && !is_vain && known_.size() < kMostKnown;
  }
  // Whether it is worth to look at the points of this tick: `add` is to be called for each.
  bool are_looked_at() const { return looks_; }

  // Whether another tick from this state has been at such a point.
  bool add(const Ticker& ticker, const ModelLeaves& leaves, const TickAnswers& answers,
           const StateCode& code, std::uint32_t asker, std::uint64_t root_ticks);

 private:
  static constexpr std::size_t kMostKnown = 100'000;  // in a state
  static constexpr std::size_t kMostInVain = 512, kMostForHit = 32;

  template <class T>
  void put(const T& value) {
    const std::size_t size = point_.size();
    point_.resize(size + sizeof value);
    std::memcpy(point_.data() + size, &value, sizeof value);
  }
  bool is_ticked_behind(const RunState& run, NodeIndex chooses) const;
  void find_parallels();
  NodeIndex child_with(NodeIndex node, NodeIndex inside) const;
  bool put_sure_to_end(const Ticker& ticker, NodeIndex node, NodeIndex next);
  bool is_halted_in_the_end(NodeIndex node) const;
  NodeIndex ends_moment(const Ticker& ticker, NodeIndex first, NodeIndex last) const;
  void put_nodes(const Ticker& ticker, NodeIndex chooses);
  void put_kept(const Ticker& ticker, NodeIndex first, NodeIndex last);
  void put_node(const Ticker& ticker, NodeIndex node, bool is_in_its_tick);

  // What a node keeps.
  struct Words {
    std::uint32_t first, count;
    bool is_dead, is_dead_when_idle;  // as fold.h has it
  };

  const Tree& tree_;
  const LeafModels& models_;
  const std::uint64_t few_;
  bool can_look_, has_properties_;
  std::vector<Words> words_;             // of each node
  std::vector<NodeIndex> kept_;          // the nodes that count also below one that has completed
  std::vector<std::uint32_t> ran_;       // leaves whose end a label tells
  std::vector<std::uint8_t> has_run_;    // the same of each leaf
  std::vector<std::uint8_t> nodes_ran_;  // of each node; for properties
  std::vector<bool> halts_only_;         // of each node: NodeKind::sure_to_end can be asked
  // Of a point: the children of such nodes of which nothing but that matters.
  std::vector<std::pair<NodeIndex, NodeIndex>> halted_;
  std::uint64_t ticks_ = 0, hits_ = 0;
  bool looks_ = false;
  StateStore known_;
  StateBytes point_;
};

}  // namespace lockstep::host

// Watches that nothing passes a barrier before all have reached it: law 4 of a run that goes on
// after a cut. It knows barriers only as numbers and the leaves only by their models, and shares
// nothing with what holds nodes in the engine.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/ticker.h"
#include "leaves/model_leaf.h"

namespace lockstep::host {

class BarrierWatch {
 public:
  // All must outlive this.
  BarrierWatch(const Tree& tree, const ModelLeaves& leaves);

  bool empty() const { return barriers_.empty(); }
  // Before the root is ticked, once its leaves are as they are in this tick.
  void before_tick(Ticker& ticker);
  // After it was ticked once.
  void after_tick(const Ticker& ticker);
  struct Passed {
    NodeIndex node, child;  // what passed the barrier of that node
    NodeIndex late;         // what has not reached it
    double barrier;
  };
  // In the last tick.
  const std::optional<Passed>& passed() const { return passed_; }
  void clear() { passed_.reset(); }

 private:
  struct Child {
    NodeIndex node;
    bool is_held;                   // the node may hold it
    std::uint32_t leaf;             // in Tree::leaves; kNoLeaf: it is none
    std::optional<double> reached;  // nothing: it does not count in this tick
    bool may_pass;                  // it gets a tick only where it may
  };
  struct Barriers {
    NodeIndex node;
    std::vector<double> list;
    bool ticks_at_barrier;
    bool is_group;
    std::vector<Child> children;
    bool is_looked_at = false;  // in this tick
  };
  static constexpr std::uint32_t kNoLeaf = 0xffffffff;

  void look_at(Ticker& ticker, const Barriers& of, Child& child) const;
  double progress(Ticker& ticker, const Child& child) const;
  void compare(const Ticker& ticker, const Barriers& of);

  const Tree& tree_;
  const ModelLeaves& leaves_;
  std::vector<Barriers> barriers_;
  std::optional<Passed> passed_;
};

}  // namespace lockstep::host

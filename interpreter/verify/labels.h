// What matters of a tick for a run that never ends, read from the engine: see LabelTable.
#pragma once

#include "verify/graph.h"
#include "verify/stepper.h"

namespace lockstep::host {

// A child of a synchronized node, or what a member of a barrier or a pool holds.
struct Holdable {
  NodeIndex holder, child;
};
std::vector<Holdable> holdable(const Tree& tree);

class Labeller {
 public:
  // Both must outlive this.
  Labeller(const Tree& tree, const LeafModels& models, std::size_t properties);

  const std::vector<Holdable>& held() const { return held_; }
  // After a tick, before its state is folded. Valid until the next call.
  const LabelTable::Bits& of(Stepper& stepper);

 private:
  bool is_held(const Ticker& ticker, const Holdable& it) const;

  const Tree& tree_;
  const LeafModels& models_;
  const std::vector<Holdable> held_;
  const std::size_t properties_;
  LabelTable::Bits bits_;
};

}  // namespace lockstep::host

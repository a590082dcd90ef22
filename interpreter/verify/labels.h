// Reads from the engine what matters of a tick for a run that never ends: see LabelShape.
#pragma once

#include "verify/label_table.h"
#include "verify/stepper.h"

namespace lockstep::host {

// A child of a synchronized node, or what a member of a barrier or a pool holds.
struct Holdable {
  NodeIndex holder, child;
};
std::vector<Holdable> holdable(const Tree& tree);

class Labeller {
 public:
  // All must outlive this.
  Labeller(const Tree& tree, const LeafModels& models, std::size_t properties,
           const Symmetry& symmetry);

  const LabelShape& shape() const { return shape_; }
  // After a tick, before its state is folded. Valid until the next call.
  const Label& of(Stepper& stepper);
  // Adds to a label without moves who is held in a tick that ends the run.
  void add_held(const Stepper& stepper, Label& label) const;
  // The same once the state is folded, with where everything went.
  const Label& with_moves(const Stepper& stepper);
  // All that matters of a tick which is in no cycle: who is held, and where those went.
  const Label& only_held(const Stepper& stepper);
  // A label without moves, of the same tick in a run where each node is at one of these places.
  Label moved(const Label& label, std::span<const NodeIndex> places) const;
  // Not of a tick: each place is after it where the one before it is with which it may change
  // places in the state that was loaded, since they are in equal children in equal states.
  Label equals(const Stepper& stepper) const;

 private:
  MovingChildren moving_children(const EqualChildren& all) const;
  bool is_held(const Stepper& stepper, const Holdable& it) const;
  void move_held(std::span<const NodeIndex> origins, bool only_held);

  const Tree& tree_;
  const LeafModels& models_;
  const std::vector<Holdable> held_;
  LabelShape shape_;
  std::vector<std::uint32_t> number_of_leaf_, number_of_held_;  // of nodes: among those that move
  Label label_;
};

}  // namespace lockstep::host

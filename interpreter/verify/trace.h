// Runs of a search once more: what each tick of one did, and the script of its leaves.
#pragma once

#include <functional>
#include <span>

#include "leaves/leaf_script.h"
#include "verify/search.h"

namespace lockstep::host {

class Tracer {
 public:
  // All must outlive this.
  Tracer(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
         Nanoseconds period, const SearchResult& found);

  // The combination of answers that takes a state over this edge.
  Step step_of(const CycleStep& edge);
  std::vector<Step> steps_of(std::span<const CycleStep> edges);

  // After each tick; its state is not folded yet.
  using After = std::function<void(Stepper&, Status status, std::size_t tick)>;
  void play(std::span<const Step> run, const After& after);

  // What each leaf does in this run.
  LeafScripts scripts(std::span<const Step> run);

 private:
  void add_words(LeafScripts& scripts);

  const Tree& tree_;
  const LeafModels& models_;
  const SearchResult& found_;
  Stepper stepper_;
  Labeller labeller_;
};

}  // namespace lockstep::host
